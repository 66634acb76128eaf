// SPDX-License-Identifier: MIT
#pragma once

/// Declarations between these two macros are the interface of a shared library, which hides all else. A static library
/// hides all, so that a plugin that contains it does not export it again. CMake and pkg-config define `MESHHOOD_SHARED`
/// where the library is shared.
#if defined(MESHHOOD_SHARED) && defined(__GNUC__) && !defined(_WIN32)
#define MESHHOOD_API_BEGIN _Pragma("GCC visibility push(default)")
#define MESHHOOD_API_END _Pragma("GCC visibility pop")
#else
#define MESHHOOD_API_BEGIN
#define MESHHOOD_API_END
#endif
