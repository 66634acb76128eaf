// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "meshhood/paper.h"

#include "parallel.h"

namespace meshhood::paper {

/// Tells the caller's `Progress` how far the build is. Nobody knows beforehand how many levels there will be, so it is
/// told of as many as are asked for: four steps each, and one for its spheres.
class Steps {
 public:
  /// `options` must outlive the steps. All members throw Error{Cancelled}.
  explicit Steps(const BuildOptions& options)
      : total_(5 * static_cast<std::size_t>(std::min(options.levels, BuildOptions::kAllLevels))),
        work_(1, options.progress, total_) {}

  void next() { advance(1); }
  void finish() { advance(total_ - done_); }

 private:
  void advance(std::size_t steps) {
    done_ += steps;
    work_.advance(steps);
    work_.report();
  }

  std::size_t total_;
  std::size_t done_ = 0;
  Work work_;
};

}  // namespace meshhood::paper
