// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "index/layout.h"
#include "search/answer.h"
#include "search/descent.h"
#include "search/foreign.h"
#include "search/leaf_walk.h"
#include "search/local_minimum.h"
#include "search/proof_memory.h"
#include "search/simd.h"

namespace meshhood {

/// The neighborhood as everything that lies in the ball, less what can be shown not to hang together with the query
/// vertex: a component that does not hold it has a vertex nearest to it, which is then a local minimum of the distance.
/// Where there is no such vertex, nothing needs to be walked through, and the cost is that of the rim.
class Cover {
 public:
  Cover(const IndexStorage& index, const Kernels& kernels)
      : index_(&index),
        kernels_(&kernels),
        descent_(index, kernels),
        foreign_(index, kernels),
        memory_(index.leaf_count()) {}

  /// Appends the exact neighborhood of the vertex at `place`, or returns false and leaves `answer` empty: then another
  /// way is shorter.
  [[nodiscard]] bool run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, LeafWalk& walk,
                         Answer& answer);

  /// Forgets earlier queries: the order of an answer then does not depend on them.
  void forget() { memory_.forget(); }

 private:
  [[nodiscard]] bool find(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, LeafWalk& walk,
                          Answer& answer);
  void collect_minima(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball);
  void fetch_ahead(std::span<const std::uint32_t> leaves) const;
  [[nodiscard]] bool is_whole(LeafId leaf, const TreeBall& ball) const;
  void append_straddling(const LeafBall& ball, std::vector<PartialLeaf>& parts) const;

  const IndexStorage* index_;
  const Kernels* kernels_;
  Descent descent_;
  Foreign foreign_;
  ProofMemory memory_;
  std::vector<LocalMinimum> minima_;  // ascending by distance
};

}  // namespace meshhood
