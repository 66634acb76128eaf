// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/query.h"
#include "exact/search/search_limits.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// A list of nodes of one level. Its buffer never shrinks.
class NodeQueue {
 public:
  void clear() { size_ = 0; }

  /// Makes room for the nodes of `groups` more groups.
  void make_room(std::size_t groups);

  /// Appends the nodes of `group` whose bits are in `set`.
  void append(std::uint32_t group, std::uint8_t set);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const std::uint32_t> nodes() const { return {nodes_.data(), size_}; }

 private:
  std::vector<std::uint32_t> nodes_;
  std::size_t size_ = 0;
};

/// Compares the tree with a ball, level by level from the root: finds the nodes inside, the leaves that intersect the
/// surface of the ball, and the candidate leaves, which may hold a local minimum of the distance from its centre.
class Descent {
 public:
  Descent(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Adds the vertices of the nodes inside to `inside`. Returns false, with incomplete results, when more nodes
  /// intersect than `limits` allow.
  [[nodiscard]] bool run(const Query& query, const SearchLimits& limits, VertexSet& inside);

  [[nodiscard]] std::span<const LeafId> intersecting_leaves() const { return intersecting_.nodes(); }
  [[nodiscard]] std::span<const LeafId> candidate_leaves() const { return candidates_.nodes(); }

 private:
  void start();
  void classify_groups(std::size_t level, const TreeBall& ball);
  void refine_candidates(std::size_t level, const TreeBall& ball);
  void refine_intersecting(std::size_t level, const TreeBall& ball);
  void add_inside(std::size_t level, VertexSet& set) const;

  const IndexView* index_;
  const Kernels* kernels_;
  NodeQueue groups_;  // the nodes of the level above, whose children are compared
  std::vector<GroupContainment> containments_;
  NodeQueue intersecting_;
  NodeQueue inside_;
  NodeQueue candidates_;  // nodes inside, and leaves that intersect
};

}  // namespace meshhood
