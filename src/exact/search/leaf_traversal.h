// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/query.h"
#include "simd/kernels.h"

namespace meshhood {

/// Searches through a ball along the edges of the mesh, a leaf at a time: a set of vertices of a leaf is one word. The
/// caller's frontier decides in which order the leaves are visited.
class LeafTraversal {
 public:
  LeafTraversal(const IndexView& index, const Kernels& kernels);

  /// Begins a new query, which must outlive the traversals in its ball. Nothing is reached or settled.
  void start(const Query& query);

  /// Reaches the vertices that are connected to the vertex `lane` of `leaf` within the ball. Returns whether it reached
  /// them all. It ends earlier when it meets a settled vertex, or when `stop(leaf, added)` returns true, which it calls
  /// for each leaf visited, with the vertices that the visit has added.
  ///
  /// frontier  emptied first; a container of leaves with `push`, `pop`, `empty`, and `clear(f)`, which calls `f` for
  ///           each leaf it removes. A leaf may be pushed again after it was popped.
  template <class Frontier, class Stop>
  [[nodiscard]] bool traverse(LeafId leaf, LaneMask lane, Frontier& frontier, Stop&& stop);

  /// The leaves in which the last traversal has reached vertices, in the order of the first visit.
  [[nodiscard]] std::span<const LeafId> reached_leaves() const { return reached_leaves_; }
  [[nodiscard]] LaneMask reached(LeafId leaf) const { return states_[leaf].reached; }

  /// Settles the reached vertices: later traversals of this query end where they meet one of them.
  void settle();

  [[nodiscard]] bool is_settled(LeafId leaf, LaneMask lane) { return (state_of(leaf).settled & lane) != 0; }

  /// Prefetches what a visit of the leaf reads, and then the output; without positions and edges if the leaf is known
  /// to be inside.
  void prefetch_leaf(const Leaf& leaf, bool intersecting = true) const;

  /// Prefetches what a visit reads of the neighbors of the leaf.
  void prefetch_neighbors(LeafId leaf) const;

  /// Prefetches the first cross edges of the leaf.
  void prefetch_cross_edges(LeafId leaf) const;

  /// For tests: continues as if `queries` queries had been started before.
  void set_query_number(std::uint32_t queries) { query_number_ = queries; }

 private:
  /// What is known of a leaf in one query.
  struct State {
    std::uint32_t query_number : 31;  // the state is valid for this query only
    std::uint32_t whole : 1;          // all vertices are in the ball, and the leaf is connected
    LaneMask inside;                  // a superset of the vertices in the ball; equal to them from the first visit on
    LaneMask reached;
    LaneMask pending;  // to be reached by the next visit, if inside; not empty while the leaf is in the frontier
    LaneMask settled;
  };

  static constexpr std::uint32_t kLastQueryNumber = (1U << 31) - 1;

  State& state_of(LeafId leaf);
  LaneMask visit(LeafId leaf);
  [[nodiscard]] bool expand(LeafId leaf, LaneMask added);

  const IndexView* index_;
  const Kernels* kernels_;
  const Query* query_ = nullptr;
  std::vector<State> states_;
  std::vector<LeafId> reached_leaves_;
  std::vector<LeafId> newly_pending_;  // found by the last `expand`
  std::uint32_t query_number_ = 0;
};

template <class Frontier, class Stop>
bool LeafTraversal::traverse(LeafId leaf, LaneMask lane, Frontier& frontier, Stop&& stop) {
  reached_leaves_.clear();
  // A traversal that ran out of memory has left leaves of its own query in both.
  newly_pending_.clear();
  frontier.clear([](LeafId) {});
  state_of(leaf).pending = lane;
  frontier.push(leaf);
  bool is_complete = true;
  while (is_complete && !frontier.empty()) {
    const LeafId next = frontier.pop();
    const LaneMask added = visit(next);
    if (added == 0) continue;
    is_complete = (added & states_[next].settled) == 0 && !stop(next, added) && !expand(next, added);
    for (const LeafId pending : newly_pending_) frontier.push(pending);
    newly_pending_.clear();
  }
  frontier.clear([this](LeafId waiting) { states_[waiting].pending = 0; });
  return is_complete;
}

}  // namespace meshhood
