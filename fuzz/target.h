// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace meshhood::fuzz {

/// What a target does with an input. Returns, or ends the program where a promise is broken.
void run(std::span<const std::byte> bytes);

}  // namespace meshhood::fuzz
