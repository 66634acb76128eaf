// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "meshhood/paper.h"

#include "base/parallel.h"

namespace meshhood::paper {

/// Reports the progress of a build. The number of levels is not known in advance, so the total assumes as many as
/// requested: four steps for each, and one for its spheres.
class Steps {
 public:
  /// `options` must outlive this object. All members throw Error{Cancelled}.
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
