// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "exact/layout.h"
#include "simd/kernels.h"

namespace meshhood {

/// Walks through a ball leaf by leaf, along the edges of the mesh: sets of vertices of a leaf are the bits of a word.
/// In what order the leaves are taken is the caller's choice.
class LeafTraversal {
 public:
  /// What the present query knows of a leaf. Of an older query: nothing.
  struct State {
    std::uint32_t query : 31;
    std::uint32_t whole : 1;  // in the ball with all its vertices, and connected
    LaneMask inside;          // what may be in the ball; exactly that once the leaf has been taken
    LaneMask reached;
    LaneMask pending;  // to be reached, if inside; the leaf waits to be taken
    LaneMask settled;  // what the caller has put aside: reached on an earlier way through the same ball
  };

  LeafTraversal(const IndexView& index, const Kernels& kernels);

  /// Begins anew. Both balls must outlive the walk.
  void start(const LeafBall& ball, const TreeBall& tree_ball);

  /// The state of a leaf, set up when the walk first meets it.
  State& touch(LeafId leaf);

  /// Takes what is pending in the leaf and returns what has thereby been reached.
  LaneMask reach(LeafId leaf);

  /// Makes pending what lies across the edges that leave the lanes `added` of the leaf. Appends to `waiting` the leaves
  /// in which nothing was pending before.
  void push_on(LeafId leaf, LaneMask added, std::vector<LeafId>& waiting);

  /// Fetches what `reach` will look at, where the leaf may straddle, and then the output.
  void fetch_leaf(const Leaf& leaf, bool intersecting = true) const;

  /// Fetches what `push_on` will look at.
  void fetch_neighbors(LeafId leaf) const;

  /// The same of edges. Where the walk goes on for long, they come by themselves while others are waited for.
  void fetch_cross_edges(LeafId leaf) const;

  /// The state of a leaf if the walk has met it.
  [[nodiscard]] const State* find(LeafId leaf) const {
    return states_[leaf].query == query_ ? &states_[leaf] : nullptr;
  }

  /// As if `queries` had been asked before: for testing what happens when the numbers of queries run out.
  void set_query(std::uint32_t queries) { query_ = queries; }

 private:
  static constexpr std::uint32_t kLastQuery = (1U << 31) - 1;

  const IndexView* index_;
  const Kernels* kernels_;
  const LeafBall* ball_ = nullptr;
  const TreeBall* tree_ball_ = nullptr;
  std::vector<State> states_;
  std::uint32_t query_ = 0;
};

}  // namespace meshhood
