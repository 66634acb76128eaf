// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace meshhood::test {

/// Whether a sanitizer is on, which needs memory and stack of its own. Compilers report this in different ways.
#if defined(__has_feature)
inline constexpr bool kSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer);
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Whether the thread sanitizer is on.
#if defined(__has_feature)
inline constexpr bool kThreadSanitized = __has_feature(thread_sanitizer);
#elif defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitized = true;
#else
inline constexpr bool kThreadSanitized = false;
#endif

/// `count` times $MESHHOOD_TEST_SCALE, at least `least`, so that slow builds run a part of each large test. Without
/// that variable all of it, or a twentieth under sanitizers. Tests print the counts that they ran.
[[nodiscard]] inline std::size_t scaled(std::size_t count, std::size_t least = 1) {
  const char* const text = std::getenv("MESHHOOD_TEST_SCALE");  // NOLINT(concurrency-mt-unsafe): tests only read it
  const double standard = kSanitized ? 0.05 : 1;
  const double scale = text == nullptr ? standard : std::strtod(text, nullptr);
  return std::max(least, static_cast<std::size_t>(std::llround(static_cast<double>(count) * scale)));
}

}  // namespace meshhood::test
