// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "meshhood/paper.h"

#include "base/parallel.h"

namespace meshhood::paper {

/// Tells the caller's `Progress` how far the build is. Nobody knows beforehand how many levels there will be, so it is
/// told of as many as are asked for: four steps each, and one for its spheres.
class Steps {
 public:
  /// `options` must outlive the steps. All members throw Error{Cancelled}.
  explicit Steps(const BuildOptions& options)
      : total_(5 * static_cast<std::size_t>(std::min(options.levels, BuildOptions::kAllLevels))),
        task_(1, options.progress, total_) {}

  void next() { advance(1); }
  void finish() { advance(total_ - done_); }

 private:
  void advance(std::size_t steps) {
    done_ += steps;
    task_.advance(steps);
    task_.report_progress();
  }

  std::size_t total_;
  std::size_t done_ = 0;
  TaskContext task_;
};

}  // namespace meshhood::paper
