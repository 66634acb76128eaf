// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "support/sanitized.h"

namespace meshhood::test {

/// `count` times $MESHHOOD_TEST_SCALE, at least `least`, so that slow builds run a part of each large test. Without
/// that variable all of it, or a twentieth under sanitizers. Tests print the counts that they ran.
[[nodiscard]] inline std::size_t scaled(std::size_t count, std::size_t least = 1) {
  const char* const text = std::getenv("MESHHOOD_TEST_SCALE");  // NOLINT(concurrency-mt-unsafe): tests only read it
  const double standard = kSanitized ? 0.05 : 1;
  const double scale = text == nullptr ? standard : std::strtod(text, nullptr);
  return std::max(least, static_cast<std::size_t>(std::llround(static_cast<double>(count) * scale)));
}

}  // namespace meshhood::test
