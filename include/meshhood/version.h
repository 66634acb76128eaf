// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

// The version is defined only here: CMake, and with it all packages, read these three lines. The inline namespace bears
// the first two.
#define MESHHOOD_VERSION_MAJOR 0
#define MESHHOOD_VERSION_MINOR 1
#define MESHHOOD_VERSION_PATCH 0

// The version as one number that grows.
#define MESHHOOD_VERSION (MESHHOOD_VERSION_MAJOR * 10000 + MESHHOOD_VERSION_MINOR * 100 + MESHHOOD_VERSION_PATCH)

#define MESHHOOD_TEXT_OF(value) #value
#define MESHHOOD_JOINED(major, minor, patch) \
  MESHHOOD_TEXT_OF(major) "." MESHHOOD_TEXT_OF(minor) "." MESHHOOD_TEXT_OF(patch)

namespace meshhood::inline v0_1 {

/// The version as text, as "0.1.0", zero-terminated. In the preprocessor, `MESHHOOD_VERSION >= 203` means 0.2.3 or
/// later.
inline constexpr std::string_view kVersion =
    MESHHOOD_JOINED(MESHHOOD_VERSION_MAJOR, MESHHOOD_VERSION_MINOR, MESHHOOD_VERSION_PATCH);

}  // namespace meshhood::inline v0_1

#undef MESHHOOD_JOINED
#undef MESHHOOD_TEXT_OF
