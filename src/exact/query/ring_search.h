// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/layout.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// Breadth-first search by the number of edges, ring after ring. The vertices of a leaf that belong to one ring are one
/// word.
class RingSearch {
 public:
  RingSearch(const IndexView& index, const Kernels& kernels);

  /// Begins with ring 0, the vertex `slot`; with nothing if it is a wall.
  void start(std::uint32_t slot);

  /// The last ring; each leaf once.
  [[nodiscard]] std::span<const LeafSubset> ring() const { return ring_; }

  /// Goes on to the next ring, which is empty if there is none.
  void advance();

 private:
  /// The state of a leaf in one search.
  struct State {
    LaneMask seen = 0;  // in a ring before the next, or walls
    LaneMask next = 0;  // in the next ring
  };

  State& state_of(LeafId leaf);
  void add(LeafId leaf, LaneMask lanes);

  const IndexView* index_;
  const Kernels* kernels_;
  EpochArray<State> states_;  // by leaf
  std::vector<LeafSubset> ring_;
  std::vector<LeafId> next_leaves_;
};

}  // namespace meshhood
