// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace meshhood::inline v0_1::io {

/// Parses the whole token as a decimal number, correctly rounded, independent of the locale. Accepts a leading `+`, and
/// `nan` and `inf` in the spellings of C. A number too large for `Real` becomes infinite, one too small becomes 0.
template <class Real>
[[nodiscard]] std::optional<Real> parse_real(std::string_view token);

/// Parses the whole token as a decimal integer with an optional sign. Empty if it is none or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view token);

/// The same for counts: 0 to 2^64 - 1.
[[nodiscard]] std::optional<std::uint64_t> parse_count(std::string_view token);

}  // namespace meshhood::inline v0_1::io
