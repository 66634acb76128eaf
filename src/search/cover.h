// SPDX-License-Identifier: MIT
#pragma once

#include "index/layout.h"
#include "search/answer.h"
#include "search/descent.h"
#include "search/proof_memory.h"
#include "search/simd.h"

namespace meshhood {

/// The neighborhood as everything that lies in the ball, where all of it can be proved to hang together: a component
/// that does not hold the query vertex has a vertex nearest to it, which is then a local minimum of the distance. Where
/// there is no such vertex, nothing needs to be walked through, and the cost is that of the rim.
class Cover {
 public:
  Cover(const IndexStorage& index, const Kernels& kernels)
      : index_(&index), kernels_(&kernels), descent_(index, kernels), memory_(index.leaf_count()) {}

  /// Appends the exact neighborhood of the vertex at `place`, or returns false and leaves `answer` as it was: then
  /// there may be more in the ball.
  [[nodiscard]] bool run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, Answer& answer);

  /// Forgets earlier queries: the order of an answer then does not depend on them.
  void forget() { memory_.forget(); }

 private:
  [[nodiscard]] bool prove(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball,
                           std::vector<VertexRange>& runs);
  [[nodiscard]] bool has_no_minimum(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball) const;
  template <class Real>
  void append_straddling(const Real* positions, const LeafBall& ball, std::vector<PartialLeaf>& parts) const;

  const IndexStorage* index_;
  const Kernels* kernels_;
  Descent descent_;
  ProofMemory memory_;
};

}  // namespace meshhood
