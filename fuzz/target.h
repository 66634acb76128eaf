// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace meshhood::fuzz {

/// Runs the target on an input. Ends the program if a promise is broken.
void run(std::span<const std::byte> bytes);

}  // namespace meshhood::fuzz
