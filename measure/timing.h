// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace meshhood::measure {

/// Seconds of processor time used by the calling thread. Unlike wall-clock time, it does not advance while the machine
/// runs something else, which would disturb the long runs of a slow method more often than the short runs of a fast
/// one. A call costs about 300 ns, too much to time a single short query.
[[nodiscard]] double processor_time();

/// The median wall-clock seconds of up to twenty calls of `run`, or of as many as fit into 20 ms. A first call warms
/// the caches and is not counted.
template <class Run>
[[nodiscard]] double median_seconds(Run&& run) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds kTimeLimit{0.02};
  constexpr std::size_t kRuns = 20;
  run();
  std::vector<Seconds> runs;
  for (Seconds spent{0}; runs.size() < kRuns && spent < kTimeLimit; spent += runs.back()) {
    const auto start = std::chrono::steady_clock::now();
    run();
    runs.emplace_back(std::chrono::steady_clock::now() - start);
  }
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end());
  return middle->count();
}

/// The machine and the build that produced a measurement.
struct Machine {
  std::string processor;
  std::string compiler;
  std::string build;  ///< "Release", ...
};

[[nodiscard]] Machine this_machine();

}  // namespace meshhood::measure
