// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/descent.h"
#include "exact/search/failure_cache.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/local_minimum.h"
#include "exact/search/other_components.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// The neighborhood as everything that lies in the ball, less what can be shown not to hang together with the query
/// vertex: a component that does not hold it has a vertex nearest to it, which is then a local minimum of the distance.
/// Where there is no such vertex, nothing needs to be walked through, and the cost is that of the rim.
class BallSearch {
 public:
  BallSearch(const IndexView& index, const Kernels& kernels)
      : index_(&index),
        kernels_(&kernels),
        descent_(index, kernels),
        other_components_(index, kernels),
        failures_(index.leaf_count()) {}

  /// Appends the exact neighborhood of the vertex at `slot`, or returns false and leaves `answer` empty: then another
  /// way is shorter.
  [[nodiscard]] bool run(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk,
                         VertexSet& answer);

  /// Forgets earlier queries: the order of an answer then does not depend on them.
  void forget() { failures_.forget(); }

 private:
  [[nodiscard]] bool find(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk,
                          VertexSet& answer);
  void collect_minima(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball);
  void fetch_ahead(std::span<const std::uint32_t> leaves) const;
  [[nodiscard]] bool is_whole(LeafId leaf, const TreeBall& ball) const;
  void append_intersecting(const LeafBall& ball, std::vector<LeafSubset>& subsets) const;

  const IndexView* index_;
  const Kernels* kernels_;
  Descent descent_;
  OtherComponents other_components_;
  FailureCache failures_;
  std::vector<LocalMinimum> minima_;  // ascending by distance
};

}  // namespace meshhood
