// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "meshhood/export.h"

// The only place of the version: CMake, and with it all packages, read these three lines.
#define MESHHOOD_VERSION_MAJOR 0
#define MESHHOOD_VERSION_MINOR 1
#define MESHHOOD_VERSION_PATCH 0

// As one number that grows.
#define MESHHOOD_VERSION (MESHHOOD_VERSION_MAJOR * 10000 + MESHHOOD_VERSION_MINOR * 100 + MESHHOOD_VERSION_PATCH)

#define MESHHOOD_TEXT_OF(value) #value
#define MESHHOOD_JOINED(major, minor, patch) \
  MESHHOOD_TEXT_OF(major) "." MESHHOOD_TEXT_OF(minor) "." MESHHOOD_TEXT_OF(patch)
#define MESHHOOD_NAME_OF(major, minor) headers_of_##major##_##minor
#define MESHHOOD_HEADERS_OF(major, minor) MESHHOOD_NAME_OF(major, minor)
#define MESHHOOD_HEADERS MESHHOOD_HEADERS_OF(MESHHOOD_VERSION_MAJOR, MESHHOOD_VERSION_MINOR)

namespace meshhood {

/// The version as text, as "0.1.0". Zero-terminated. For the preprocessor: `MESHHOOD_VERSION >= 203` from 0.2.3 on.
inline constexpr std::string_view kVersion =
    MESHHOOD_JOINED(MESHHOOD_VERSION_MAJOR, MESHHOOD_VERSION_MINOR, MESHHOOD_VERSION_PATCH);

namespace detail MESHHOOD_API {

/// Each object that is compiled with these headers refers to it, and only the library of the same minor version defines
/// it. So an object does not link to a library whose classes may differ.
extern const char MESHHOOD_HEADERS;

#if defined(__ELF__)
[[gnu::used]] static const char* const kHeaders = &MESHHOOD_HEADERS;
#endif

}  // namespace detail

}  // namespace meshhood

#undef MESHHOOD_JOINED
#undef MESHHOOD_TEXT_OF
