// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

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

  /// Whether the answer may well lie in few leaves: the ball is tiny, or the leaf of the query vertex has no links. The
  /// search in few leaves prefetches nothing, so it takes less time than the others in larger balls too if what it
  /// reads is in the cache, as after a query in the same leaf (`is_near`), and more time if not. Chosen.
  [[nodiscard]] bool may_lie_in_few_leaves(double radius_in_frame, LeafId home, bool is_near,
                                           const IndexView& index) const {
    const double mean_leaf_radii = is_near ? 2.0 : 0.4;
    const bool is_tiny = radius_in_frame < mean_leaf_radii * index.tree[0].mean_radius;
    return enabled && (is_tiny || index.links_of(home).empty());
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

/// What an outward search did.
struct SearchRecord {
  std::size_t surface_leaves;
  std::size_t answer_leaves;  // as many as the vertices of the answer would fill
  std::size_t steps;          // of the search for other components: leaves in doubt, and visits of leaves
};

/// Means over recent searches, to choose between the ways to search. Means of counts, not of their ratios, because what
/// matters is the time of all searches together.
class SearchMemory {
 public:
  /// Forgets all earlier queries, so that the order of the next answer does not depend on them.
  void clear() { *this = {}; }

  /// Whether the query before was in the same leaf. Call it once for each query.
  [[nodiscard]] bool enter(LeafId home) { return std::exchange(last_home_, home) == home; }

  /// Begins a ball. For one ball in 16 or more, all functions except `expects_one_vertex` return false, because the
  /// ball may lie in another part of the mesh, or be of another size.
  void begin_ball(double radius) {
    constexpr double kOtherSize = 2;  // chosen
    const bool is_as_before = radius <= kOtherSize * tried_radius_ && tried_radius_ <= kOtherSize * radius;
    is_retry_ = ++balls_since_retry_ >= (is_as_before ? retry_interval_ : kShortestInterval);
    if (!is_retry_) return;
    balls_since_retry_ = 0;
    tried_radius_ = radius;
  }

  /// Whether the search for other components took longer than uniting all that was reached would take.
  [[nodiscard]] bool should_unite() const {
    // Chosen: uniting takes about as long as one step for each surface leaf. A little more, because a few expensive
    // balls do not mean that the next is expensive.
    constexpr double kStepsToUnite = 1.3;
    return is_experienced() && steps_ > kStepsToUnite * surface_leaves_;
  }

  /// Whether the breadth-first search over leaves, which visits only the leaves of the answer, would take less time.
  [[nodiscard]] bool is_answer_small() const {
    return is_experienced() && visits_would_take_less(steps_, surface_leaves_, answer_leaves_);
  }

  /// After an outward search that has searched for other components.
  void record(const SearchRecord& search) {
    ++searches_;
    approach(surface_leaves_, search.surface_leaves);
    approach(answer_leaves_, search.answer_leaves);
    approach(steps_, search.steps);
    retry_interval_ = interval_after(search);
  }

  /// Whether beginning with large nodes was mostly useless: they reached more than a single sheet.
  [[nodiscard]] bool should_start_small() const {
    constexpr double kMostFailures = 0.7;  // chosen
    return large_start_failures_ > kMostFailures && !is_retry_;
  }

  /// After an outward search that began with large nodes.
  void record_large_start(bool is_single_sheet) { approach(large_start_failures_, is_single_sheet ? 0 : 1); }

  /// Whether most answers in few leaves were the query vertex alone.
  [[nodiscard]] bool expects_one_vertex() const { return one_vertex_share_ > 0.5; }

  /// After an answer in few leaves.
  void record_few_leaves(bool is_one_vertex) { approach(one_vertex_share_, is_one_vertex ? 1 : 0); }

 private:
  // Balls from one that is tried again to the next; chosen.
  static constexpr std::size_t kShortestInterval = 16;  // if balls may have changed
  static constexpr std::size_t kShortInterval = 64;     // otherwise, at least
  static constexpr std::size_t kLongestInterval = 2048;

  /// Whether enough balls have been searched. A single one may be unlike all others.
  [[nodiscard]] bool is_experienced() const {
    constexpr std::size_t kFewest = 4;  // chosen
    return searches_ >= kFewest && !is_retry_;
  }

  /// For the numbers of one search, or for their means.
  template <class Number>
  [[nodiscard]] static bool visits_would_take_less(Number steps, Number surface_leaves, Number answer_leaves) {
    // Chosen: the steps that a leaf of the answer takes there, and those that a surface leaf takes here besides.
    constexpr double kStepsToVisit = 1.5;
    constexpr double kStepsToReach = 0.5;
    return static_cast<double>(steps) + kStepsToReach * static_cast<double>(surface_leaves) >
           kStepsToVisit * static_cast<double>(answer_leaves);
  }

  /// The more steps were in vain, the fewer balls are tried again: together, they take about as long as a tenth of the
  /// breadth-first searches between them. If the search was the right one, balls may have changed.
  [[nodiscard]] static std::size_t interval_after(const SearchRecord& search) {
    if (!visits_would_take_less(search.steps, search.surface_leaves, search.answer_leaves)) return kShortestInterval;
    const std::size_t steps_per_leaf = search.steps / std::max<std::size_t>(search.answer_leaves, 1);
    return std::clamp(10 * steps_per_leaf, kShortInterval, kLongestInterval);
  }

  /// Moves a mean towards a value.
  static void approach(double& mean, std::size_t value) {
    constexpr double kSearches = 8;  // chosen
    constexpr double kLeast = 1e-9;  // becomes zero: denormal numbers are slow
    mean += (static_cast<double>(value) - mean) / kSearches;
    if (mean < kLeast) mean = 0;
  }

  static constexpr LeafId kNoLeaf = std::numeric_limits<LeafId>::max();

  LeafId last_home_ = kNoLeaf;
  std::size_t searches_ = 0;
  double surface_leaves_ = 0;
  double answer_leaves_ = 0;
  double steps_ = 0;
  double large_start_failures_ = 0;  // their share
  double one_vertex_share_ = 0;      // the share of answers in few leaves that were one vertex
  std::size_t retry_interval_ = kShortestInterval;
  std::size_t balls_since_retry_ = 0;
  double tried_radius_ = 0;
  bool is_retry_ = false;
};

}  // namespace meshhood
