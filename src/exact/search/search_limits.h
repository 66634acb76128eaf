// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "exact/layout.h"
#include "exact/search/query.h"

namespace meshhood {

/// The limits that choose between the ways to search (see searcher.cpp). They decide how long a query takes and in what
/// order its answer comes, never which vertices are in it.
///
/// Factors marked "chosen" are not derived: they were tuned on the meshes of docs/benchmarks.md.
struct SearchLimits {
  /// False in tests: every query is then answered by the outward search, whatever it costs.
  bool enabled = true;

  /// Whether hardly any leaf lies inside the ball, so that the breadth-first search visits no more leaves than the
  /// outward search. Chosen.
  [[nodiscard]] bool is_small(double radius_in_frame, const IndexView& index) const {
    constexpr double kMeanLeafRadii = 1.8;
    return enabled && radius_in_frame < kMeanLeafRadii * index.tree[0].mean_radius;
  }

  /// Whether the answer may well lie in few leaves: the ball is tiny, or the leaf of the query vertex has no links. In
  /// larger balls this search would take less time when everything is in the cache, and more when nothing is. Chosen.
  [[nodiscard]] bool may_lie_in_few_leaves(double radius_in_frame, LeafId home, const IndexView& index) const {
    constexpr double kMeanLeafRadii = 0.4;
    const bool is_tiny = radius_in_frame < kMeanLeafRadii * index.tree[0].mean_radius;
    return enabled && (is_tiny || index.links_of(home).empty());
  }

  /// Whether the ball is so small that the breadth-first search is faster on a folded mesh. Chosen.
  [[nodiscard]] bool is_small_if_folded(const Query& query, const IndexView& index) const {
    constexpr double kMeanLeafRadii = 4.4;
    return enabled && query.radius_in_frame < kMeanLeafRadii * index.tree[0].mean_radius;
  }

  /// The most nodes of a level that may intersect the surface of the ball: more than one sheet of mesh has.
  ///
  /// On a plane, nodes that are squares with a half diagonal of m have an area of 2 m^2. The nodes that intersect have
  /// their centers within m of a circle of radius r, so there are about 4 pi r m / 2 m^2 = 6.3 r / m of them; on a
  /// smooth scan, 5.6 were measured. 14 is chosen: a little more than two such sheets. So is 12, for balls no larger
  /// than a node: a group and a half.
  [[nodiscard]] std::size_t most_intersecting(double radius_in_frame, double mean_radius) const {
    if (!enabled) return std::numeric_limits<std::size_t>::max();
    return 12 + static_cast<std::size_t>(std::min(14 * radius_in_frame / mean_radius, 1e9));
  }

  /// The most leaves to be visited in other components. Uniting all that was reached takes about as long as that many
  /// visits: it looks at each surface leaf, and at the links of the nodes. Chosen.
  [[nodiscard]] std::size_t most_visited(std::size_t surface_leaves) const {
    if (!enabled) return std::numeric_limits<std::size_t>::max();
    return 16 + surface_leaves;
  }
};

/// Statistics of recent searches, to choose between the outward search and the breadth-first search.
class SearchMemory {
 public:
  /// Forgets all earlier queries, so that the order of the next answer does not depend on them.
  void clear() { *this = {}; }

  /// Begins a ball. For one ball in 16 or more, all functions except `was_alone` return false, because the ball may lie
  /// in another part of the mesh, or be of another size.
  void begin_ball(double radius) {
    constexpr double kOtherSize = 2;  // chosen
    const bool is_as_before = radius <= kOtherSize * tried_radius_ && tried_radius_ <= kOtherSize * radius;
    is_retry_ = ++balls_since_retry_ >= (is_as_before ? retry_interval_ : kShortestInterval);
    if (!is_retry_) return;
    balls_since_retry_ = 0;
    tried_radius_ = radius;
  }

  /// Whether the mesh was folded: many leaves at the surface of the balls were in doubt.
  [[nodiscard]] bool is_folded() const {
    // Chosen: the share is 0.1 on the dragon, 0.15 on bodies, and 0.35 to 0.45 on brains.
    constexpr double kFolded = 0.3;
    return share_in_doubt_ > kFolded && !is_retry_;
  }

  /// Whether the search for other components took longer than uniting all that was reached would take.
  [[nodiscard]] bool is_torn() const {
    // Chosen: uniting takes about as long as one step for each surface leaf. A little more, because a few expensive
    // balls do not mean that the next is expensive.
    constexpr double kTorn = 1.3;
    return steps_per_surface_leaf_ > kTorn && !is_retry_;
  }

  /// Whether the answers had fewer leaves than the search for other components took steps. The breadth-first search,
  /// which visits only the leaves of the answer, is then faster.
  [[nodiscard]] bool is_answer_small() const {
    return answer_per_surface_leaf_ < steps_per_surface_leaf_ && !is_retry_;
  }

  /// Whether most answers in few leaves were the query vertex alone.
  [[nodiscard]] bool was_alone() const { return alone_ > kAlways / 2; }

  /// After an answer in few leaves.
  void record_alone(bool is_alone) { remember(alone_, is_alone); }

  /// Whether beginning with large nodes was mostly useless: they reached more than a single sheet.
  [[nodiscard]] bool should_start_small() const {
    constexpr int kMostFailures = kAlways * 7 / 10;  // chosen
    return large_start_failures_ > kMostFailures && !is_retry_;
  }

  /// After an outward search that began with large nodes.
  void record_large_start(bool is_single_sheet) { remember(large_start_failures_, !is_single_sheet); }

  /// After an outward search: `in_doubt` of its `surface` leaves were in doubt, and the search for other components
  /// took `steps`: leaves in doubt, and visits of leaves.
  void record(std::size_t in_doubt, std::size_t surface, std::size_t steps) {
    constexpr double kMemory = 8;  // balls; chosen
    balls_ = std::min(balls_ + 1, kMemory);
    steps_ = steps;
    approach(share_in_doubt_, in_doubt, surface);
    approach(steps_per_surface_leaf_, steps, surface);
  }

  /// After an outward search whose answer fills `leaves` leaves.
  void record_answer(std::size_t leaves, std::size_t surface) {
    approach(answer_per_surface_leaf_, leaves, surface);
    // The more steps were in vain, the fewer balls are tried again: together, they take about as long as a quarter of
    // the breadth-first searches between them.
    const std::size_t steps_per_leaf = steps_ / std::max<std::size_t>(leaves, 1);
    retry_interval_ = std::clamp(4 * steps_per_leaf, kShortestInterval, kLongestInterval);
  }

 private:
  void approach(double& share, std::size_t part, std::size_t all) const {
    constexpr double kLeast = 1e-6;  // otherwise a share of nothing would decay until it is denormal, which is slow
    const double now = static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
    share = std::max(share + (now - share) / balls_, kLeast);
  }

  static constexpr int kAlways = 256;
  static constexpr std::size_t kShortestInterval = 16;  // balls; chosen
  static constexpr std::size_t kLongestInterval = 512;  // chosen

  static void remember(int& share, bool is_so) {
    constexpr int kAnswers = 8;  // chosen
    share += ((is_so ? kAlways : 0) - share) / kAnswers;
  }

  double balls_ = 0;
  double share_in_doubt_ = 0;
  double steps_per_surface_leaf_ = 0;
  double answer_per_surface_leaf_ = 0;
  // Shares of answers, of `kAlways`.
  int alone_ = 0;  // that were one vertex
  int large_start_failures_ = 0;
  std::size_t steps_ = 0;  // of the last search
  std::size_t retry_interval_ = kShortestInterval;
  std::size_t balls_since_retry_ = 0;
  double tried_radius_ = 0;
  bool is_retry_ = false;
};

}  // namespace meshhood
