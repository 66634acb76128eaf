// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"
#include "exact/search/home_marks.h"
#include "exact/search/query.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// A vertex of the ball without a neighbor that is nearer to the query vertex.
struct LocalMinimum {
  double square;  // of its distance, by the predicate
  LeafId leaf;
  unsigned lane;
};

/// Finds the local minima of the distance in *loose pieces*: parts of the ball in one leaf, connected there, that no
/// edge joins with a vertex of a marked node. Every component of the ball without the query vertex has one of its
/// nearest vertices among them: no vertex of it is marked; its nearest vertex is a local minimum, so its leaf is in
/// doubt, and so is the whole node that covers the leaf, if there is one.
class LoosePieces {
 public:
  LoosePieces(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// groups          those of known state, larger nodes first
  /// surface_leaves  the leaves that intersect the surface of the ball, with their vertices in the ball
  void find(const Query& query, std::span<const std::uint32_t> groups, std::span<const LeafSubset> surface_leaves,
            HomeMarks& marks, GroupStates& states);

  /// The number of leaves in doubt that were cut.
  [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }

  /// Ascending by distance.
  [[nodiscard]] std::span<const LocalMinimum> minima() const { return minima_; }

 private:
  void gather_surface_leaves(std::span<const LeafSubset> surface_leaves, const GroupStates& states);
  void gather_whole(std::span<const std::uint32_t> groups, const TreeBall& ball, HomeMarks& marks, GroupStates& states);
  void gather_below(std::uint32_t group, const TreeBall& ball);
  void cut_from(std::size_t first, const Query& query, HomeMarks& marks, GroupStates& states);
  void cut(const LeafSubset& leaf, const Query& query, HomeMarks& marks, GroupStates& states);
  [[nodiscard]] bool touches_home(LeafId leaf, LaneMask piece, HomeMarks& marks, GroupStates& states) const;
  [[nodiscard]] bool has_nearer_neighbor(const LocalMinimum& vertex, const Point& center) const;

  const IndexView* index_;
  const Kernels* kernels_;
  std::vector<LeafSubset> leaves_;  // in doubt; first the surface leaves
  std::size_t leaf_count_ = 0;
  std::vector<LocalMinimum> minima_;
};

}  // namespace meshhood
