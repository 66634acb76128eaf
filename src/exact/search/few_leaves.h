// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "exact/layout.h"
#include "exact/search/vertex_set.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood {

/// Answers in few leaves, as in small balls and in components of few vertices. The preparations of the other searches
/// would take longer than such a query.
class FewLeaves {
 public:
  static constexpr unsigned kMostLeaves = 32;

  FewLeaves(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Whether no edge leads from the vertex at `slot`, the center of the ball, to another vertex of the ball. Compares
  /// its neighbors with the ball one by one.
  [[nodiscard]] bool is_isolated(std::uint32_t slot, const Point& center, double squared_radius) const;

  /// Adds the neighborhood of the vertex at `slot`, the center of the ball, to `answer`, which is empty. Returns false,
  /// and adds nothing, if the vertices of the answer and their neighbors lie in more than `kMostLeaves` leaves.
  [[nodiscard]] bool find(std::uint32_t slot, const LeafBall& ball, VertexSet& answer);

  /// The number of leaves that the last `find` has met.
  [[nodiscard]] std::size_t leaf_count() const { return count_; }

 private:
  /// A leaf that the search has met.
  struct Met {
    LeafId leaf;
    LaneMask open;     // in the ball, and not reached
    LaneMask reached;  // connected with the query vertex in the ball
    LaneMask pending;  // the open ones with an edge from a reached vertex of another leaf
  };

  /// Leaves are numbered as they are met. A hash table finds their numbers.
  static constexpr std::size_t kTableSize = 64;

  [[nodiscard]] unsigned number_of(LeafId leaf, const LeafBall& ball);
  LaneMask grow(Met& met);
  [[nodiscard]] bool expand(LeafId leaf, LaneMask added, const LeafBall& ball);

  const IndexView* index_;
  const Kernels* kernels_;
  std::array<Met, kMostLeaves> met_{};
  std::array<std::uint8_t, kTableSize> table_{};  // by hash of the leaf: its number, and one more; 0 if there is none
  unsigned count_ = 0;
  std::uint32_t waiting_ = 0;  // the numbers of the leaves with pending vertices, as bits
};

}  // namespace meshhood
