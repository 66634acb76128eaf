// SPDX-License-Identifier: MIT
#pragma once

/// Stands after the name of a namespace whose declarations are the interface of a shared library, which hides all
/// others. A static library hides all, so that a plugin that contains it does not export it again. CMake and pkg-config
/// define `MESHHOOD_SHARED` where the library is shared.
#if defined(MESHHOOD_SHARED) && defined(__GNUC__) && !defined(_WIN32)
#define MESHHOOD_API __attribute__((visibility("default")))
#else
#define MESHHOOD_API
#endif
