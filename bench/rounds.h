// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>

#include "measure/timing.h"

namespace meshhood::bench {

inline constexpr int kRounds = 5;

/// Processor seconds of the fastest round, of each of the runs, which take turns.
template <std::size_t N>
std::array<double, N> fastest(const std::array<std::function<void()>, N>& runs) {
  std::array<double, N> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < N; ++i) {
      const double start = measure::processor_time();
      runs[i]();
      least[i] = std::min(least[i], measure::processor_time() - start);
    }
  }
  return least;
}

/// The same of one run, in microseconds for each of its rows.
template <class Run>
double microseconds(std::size_t rows, const Run& run) {
  return 1e6 * fastest<1>({run})[0] / static_cast<double>(rows);
}

}  // namespace meshhood::bench
