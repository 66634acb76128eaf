// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "index/layout.h"
#include "search/answer.h"
#include "search/simd.h"

namespace meshhood {

/// Breadth-first search whose steps are leaves: looks at no leaf that the answer does not touch, at most at its
/// neighbours. Costs as much as the answer has leaves, wherever else the surface may lie.
class Flood {
 public:
  Flood(const IndexStorage& index, const Kernels& kernels);

  /// Appends the exact neighborhood of the vertex at `place` (see IndexStorage).
  void run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, Answer& answer);

  /// As if `queries` had been asked before: for testing what happens when the numbers of queries run out.
  void set_query(std::uint32_t queries) { query_ = queries; }

 private:
  /// What the present query knows of a leaf. Of an older query: nothing.
  struct State {
    std::uint32_t query : 31;
    std::uint32_t whole : 1;  // in the ball with all its vertices, and connected
    Lanes inside;             // what may be in the ball; exactly that once the leaf has been taken from the queue
    Lanes reached;
    Lanes pending;  // to be reached, if inside; the leaf waits in the queue
  };
  static constexpr std::uint32_t kLastQuery = (1U << 31) - 1;

  template <class Real>
  void run_on(const Real* positions, std::uint32_t place, Answer& answer);

  void start_query();
  void fetch_neighbors(LeafId leaf) const;
  void fetch_leaf(const Leaf& leaf, bool straddling) const;
  State& touch(LeafId leaf);
  template <class Real>
  Lanes reach(const Real* positions, LeafId leaf, State& state) const;
  void push_on(LeafId leaf, Lanes added);
  void append_to(Answer& answer) const;

  const IndexStorage* index_;
  const Kernels* kernels_;
  const LeafBall* ball_ = nullptr;
  const TreeBall* tree_ball_ = nullptr;
  std::vector<State> states_;
  std::uint32_t query_ = 0;
  std::vector<LeafId> queue_;
  std::vector<LeafId> reached_;
};

}  // namespace meshhood
