// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// Nodes of one level, in a buffer that keeps its size.
class NodeQueue {
 public:
  void clear() { size_ = 0; }

  /// Makes room for the children of `groups` groups more.
  void make_room(std::size_t groups);

  /// Appends those children of `group` that are in `set`.
  void append(std::uint32_t group, std::uint8_t set);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const std::uint32_t> nodes() const { return {nodes_.data(), size_}; }

 private:
  std::vector<std::uint32_t> nodes_;
  std::size_t size_ = 0;
};

/// What the tree says of a ball: which nodes lie inside, which leaves straddle its surface, and which leaves might hold
/// a local minimum of the distance from its centre (see region.h). Goes down level by level.
class Descent {
 public:
  Descent(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Appends the vertices of the nodes inside to `runs`. False if so many nodes straddle that much else than one sheet
  /// of surface must pass through the ball; the results are then incomplete.
  [[nodiscard]] bool run(const TreeBall& ball, std::vector<VertexRange>& runs);

  [[nodiscard]] std::span<const std::uint32_t> intersecting_leaves() const { return intersecting_.nodes(); }
  [[nodiscard]] std::span<const std::uint32_t> candidate_leaves() const { return candidates_.nodes(); }

 private:
  void classify_groups(std::size_t level, std::span<const std::uint32_t> groups, const TreeBall& ball);
  void refine_intersecting(std::size_t level, const TreeBall& ball);
  void refine_candidates(std::size_t level, const TreeBall& ball);
  void append_inside(std::size_t level, std::vector<VertexRange>& runs) const;

  const IndexView* index_;
  const Kernels* kernels_;
  std::vector<GroupContainment> containments_;
  NodeQueue intersecting_;
  NodeQueue inside_;
  NodeQueue candidates_;  // inside, or a intersecting leaf
  NodeQueue groups_;
};

}  // namespace meshhood
