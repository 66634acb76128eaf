// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Numbers as people read them. JSON has them in full.
namespace meshhood::cli {

/// "1.76 GB", with a unit of powers of 1000.
[[nodiscard]] std::string bytes_text(double bytes, int digits = 3);

/// "42,000", with three significant digits.
[[nodiscard]] std::string rounded_text(double number);

}  // namespace meshhood::cli
