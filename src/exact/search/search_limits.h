// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "exact/layout.h"
#include "exact/search/query.h"

namespace meshhood {

/// The limits at which a search gives up the proof (see searcher.cpp) and takes the breadth-first search instead. They
/// decide how long a query takes and in what order its answer comes, never which vertices are in it.
///
/// Factors marked "chosen" are not derived: they were tuned on the meshes of docs/benchmarks.md.
struct SearchLimits {
  /// False in tests: every query is then answered by the proof, whatever it costs.
  bool enabled = true;

  /// Whether hardly any leaf lies inside the ball, so that the breadth-first search visits no more leaves than the
  /// descent. Chosen.
  [[nodiscard]] bool is_small(const Query& query, const IndexView& index) const {
    constexpr double kMeanLeafRadii = 1.8;
    return enabled && query.radius_in_frame < kMeanLeafRadii * index.tree[0].mean_radius;
  }

  /// The most nodes of a level that may intersect the surface of the ball: more than one sheet of mesh has.
  ///
  /// On a plane, nodes that are squares with a half diagonal of m have an area of 2 m^2. The nodes that intersect have
  /// their centres within m of a circle of radius r, so there are about 4 pi r m / 2 m^2 = 6.3 r / m of them; on a
  /// smooth scan, 5.6 were measured. 14 is chosen: a little more than two such sheets. So is 12, for balls no larger
  /// than a node: a group and a half.
  [[nodiscard]] std::size_t most_intersecting(double radius_in_frame, double mean_radius) const {
    if (!enabled) return std::numeric_limits<std::size_t>::max();
    return 12 + static_cast<std::size_t>(std::min(14 * radius_in_frame / mean_radius, 1e9));
  }

  /// The most leaves to be searched for local minima, in a ball of `leaves` leaves. Chosen.
  [[nodiscard]] std::size_t most_candidates(std::size_t leaves) const {
    if (!enabled) return std::numeric_limits<std::size_t>::max();
    return std::min(leaves, 16 + leaves / 4);
  }

  /// The most leaves to be visited in other components. Chosen.
  [[nodiscard]] std::size_t most_visited(std::size_t leaves) const {
    if (!enabled) return std::numeric_limits<std::size_t>::max();
    return std::min(leaves / 2, 16 + leaves / 10);
  }
};

/// Remembers where and from which radius on the proof failed lately. It will probably fail there again.
class FailureCache {
 public:
  explicit FailureCache(std::size_t leaves) : entries_(leaves / kFanOut + 1) {}

  /// Forgets all earlier queries, so that the order of the next answer does not depend on them.
  void clear() { ++round_; }

  [[nodiscard]] bool should_try(const Query& query) {
    Entry& entry = entry_of(query.leaf());
    // Tries again now and then, because a neighbouring vertex may succeed.
    return query.radius < entry.failed_from || ++entry.skipped % kRetryInterval == 0;
  }

  void record(const Query& query, bool proved) {
    Entry& entry = entry_of(query.leaf());
    if (!proved && query.radius < entry.failed_from) entry.failed_from = query.radius;
    if (proved && query.radius >= entry.failed_from) entry.failed_from = std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::uint32_t kRetryInterval = 16;  // chosen

  struct Entry {
    double failed_from = std::numeric_limits<double>::infinity();
    std::uint32_t skipped = 0;
    std::uint32_t round = 0;
  };

  Entry& entry_of(LeafId leaf) {
    Entry& entry = entries_[leaf / kFanOut];
    if (entry.round != round_) entry = {.round = round_};
    return entry;
  }

  std::vector<Entry> entries_;  // by group of leaves; entries of an earlier round are not valid
  std::uint32_t round_ = 0;
};

}  // namespace meshhood
