// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "base/epoch_array.h"
#include "base/number_set.h"
#include "exact/layout.h"
#include "exact/search/query.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Breadth-first search over leaves: a set of vertices of a leaf is one word. It visits the leaves of the answer and
/// looks at their neighbors, so its cost does not depend on what else lies in the ball.
class LeafBfs {
 public:
  LeafBfs(const IndexView& index, const Kernels& kernels)
      : index_(&index), kernels_(&kernels), states_(index.leaf_count()), reached_(index.leaf_count()) {}

  /// Adds the neighborhood of the query to `answer`, which is empty.
  void run(const Query& query, VertexSet& answer) {
    static_cast<void>(run_within(std::numeric_limits<std::size_t>::max(), query, answer));
  }

  /// Does the same in at most so many visits of leaves. If these do not suffice, it returns false and adds nothing.
  [[nodiscard]] bool run_within(std::size_t visits, const Query& query, VertexSet& answer);

  /// Prefetches what a visit of the leaf reads, and then the output; without positions and edges if the leaf is known
  /// to be inside.
  void prefetch_leaf(const Leaf& leaf, bool is_intersecting) const;

 private:
  /// What is known of a leaf in one query.
  struct State {
    LaneMask open = 0;  // not reached, and perhaps in the ball; from the first visit on, surely
    LaneMask reached = 0;
    LaneMask pending = 0;   // to be reached by the next visit, if open; not empty while the leaf is in the queue
    bool is_whole = false;  // all vertices are in the ball, and the leaf is connected
    bool is_visited = false;
  };

  State& state_of(LeafId leaf);
  LaneMask visit(LeafId leaf);
  void expand(LeafId leaf, LaneMask added);
  void prefetch_ahead();

  const IndexView* index_;
  const Kernels* kernels_;
  const Query* query_ = nullptr;
  EpochArray<State> states_;  // by leaf
  std::vector<LeafId> queue_;
  std::size_t head_ = 0;
  std::size_t prefetched_ = 0;
  NumberSet reached_;  // leaves
};

}  // namespace meshhood::inline v0_1
