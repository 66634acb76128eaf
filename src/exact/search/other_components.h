// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "exact/layout.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/local_minimum.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// What lies in the ball but does not hang together with the query vertex there. The nearest vertex of every such
/// component is a local minimum of the distance. From each minimum, the nearest first, one walks on, downhill where
/// that is possible, until something nearer is met or nothing is left of the component. What is nearer hangs together
/// with the query vertex: else its component would have been walked through before, this minimum included.
class OtherComponents {
 public:
  OtherComponents(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Finds all these components. False if that takes more than `budget` leaves.
  ///
  /// minima  the nearest vertices of these components, and any others of the ball; ascending by distance.
  [[nodiscard]] bool find(std::uint32_t slot, std::span<const LocalMinimum> minima, std::size_t budget,
                          const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk);

  /// Takes them away from `answer`, which holds the whole ball.
  void cut_from(VertexSet& answer);

 private:
  enum class End : std::uint8_t { Met, Exhausted, OverBudget };

  void start_walk(LeafId leaf, LaneMask lane, LeafTraversal& walk);
  [[nodiscard]] End finish_walk(double square, LeafTraversal& walk);
  [[nodiscard]] bool has_nearer(LeafId leaf, LaneMask lanes, double square) const;
  void wait(LeafId leaf);
  void settle(LeafTraversal& walk);
  void append_reached(LeafTraversal& walk);
  void put_in_order();
  void append_what_is_left(const VertexRange& run, std::vector<LeafSubset>& subsets);
  [[nodiscard]] std::vector<LeafSubset>::const_iterator first_from(VertexId vertex) const;

  const IndexView* index_;
  const Kernels* kernels_;
  const LeafBall* ball_ = nullptr;
  const TreeBall* tree_ball_ = nullptr;
  std::size_t budget_ = 0;
  std::vector<std::pair<float, LeafId>> heap_;  // squared distance from the query vertex, leaf
  std::vector<LeafId> waiting_;
  std::vector<LeafId> reached_;
  std::vector<LeafSubset> found_;  // in index order
  std::vector<VertexRange> runs_;
};

}  // namespace meshhood
