// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "exact/layout.h"

namespace meshhood {

/// Where a searcher has lately failed to prove that the ball is the answer: there it will probably fail again, from
/// that radius on, and need not try. Only saves time; an answer never depends on it, but the order of its vertices
/// does.
class FailureCache {
 public:
  explicit FailureCache(std::size_t leaves) : entries_(leaves / kFanOut + 1) {}

  /// As if it were new.
  void forget() { ++round_; }

  [[nodiscard]] bool should_try(LeafId leaf, double radius) {
    Entry& entry = entry_of(leaf);
    // Once in a while all the same, for a neighbour may succeed.
    return radius < entry.failed_from || ++entry.passed_over % kPatience == 0;
  }

  void record(LeafId leaf, double radius, bool proved) {
    Entry& entry = entry_of(leaf);
    if (!proved && radius < entry.failed_from) entry.failed_from = radius;
    if (proved && radius >= entry.failed_from) entry.failed_from = std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::uint32_t kPatience = 16;

  struct Entry {
    double failed_from = std::numeric_limits<double>::infinity();
    std::uint32_t passed_over = 0;
    std::uint32_t round = 0;
  };

  Entry& entry_of(LeafId leaf) {
    Entry& entry = entries_[leaf / kFanOut];
    if (entry.round != round_) entry = {.round = round_};
    return entry;
  }

  std::vector<Entry> entries_;  // by group of leaves; what is left of an earlier round is forgotten
  std::uint32_t round_ = 0;
};

}  // namespace meshhood
