// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "index/layout.h"
#include "search/answer.h"
#include "search/leaf_walk.h"

namespace meshhood {

/// Breadth-first search whose steps are leaves: looks at no leaf that the answer does not touch, at most at its
/// neighbours. Costs as much as the answer has leaves, wherever else the surface may lie.
class Flood {
 public:
  explicit Flood(const IndexStorage& index) : index_(&index) {}

  /// Appends the exact neighborhood of the vertex at `place` (see IndexStorage).
  void run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, LeafWalk& walk, Answer& answer);

 private:
  void append_to(const LeafWalk& walk, Answer& answer) const;

  const IndexStorage* index_;
  std::vector<LeafId> queue_;
  std::vector<LeafId> reached_;
};

}  // namespace meshhood
