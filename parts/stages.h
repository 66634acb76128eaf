// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "meshhood/error.h"
#include "meshhood/run.h"

namespace meshhood::parts {

/// The progress of a run in stages: each stage has a share of the whole.
class Stages {
 public:
  explicit Stages(const Progress& progress) : progress_(progress) { report(0); }

  /// Begins a stage, at whose end `share` of the whole is done.
  void begin(double share) {
    begin_ = end_;
    end_ = share;
    report(0);
  }

  void report(double fraction) {
    done_ = std::max(done_, static_cast<std::size_t>(kTotal * (begin_ + (end_ - begin_) * std::min(1.0, fraction))));
    if (progress_ && !progress_(done_, kTotal)) raise(ErrorCode::Cancelled, "cancelled");
  }

  void report(std::uint64_t done, std::uint64_t total) {
    report(total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total));
  }

 private:
  static constexpr std::size_t kTotal = 10'000;

  const Progress& progress_;
  double begin_ = 0;
  double end_ = 0;
  std::size_t done_ = 0;
};

}  // namespace meshhood::parts
