// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"
#include "exact/search/home_marks.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/loose_pieces.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// The components of the ball that do not hold the query vertex. The nearest vertex of each is a local minimum of the
/// distance. From each minimum, nearest first, a traversal visits the nearest leaves first until it meets a vertex that
/// is nearer than the minimum or belongs to a marked node, or has reached the whole component.
///
/// A nearer vertex is connected with the query vertex: otherwise its component would have a minimum that is nearer, and
/// that component, which holds this minimum too, would have been reached from there and settled.
class OtherComponents {
 public:
  OtherComponents(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Finds all these components. Returns false when that takes more than `most_visited` visits of leaves.
  ///
  /// minima  ascending by distance: the nearest vertex of each of these components, and any other vertices of the ball.
  [[nodiscard]] bool find(const Query& query, std::span<const LocalMinimum> minima, HomeMarks& marks,
                          GroupStates& states, std::size_t most_visited, LeafTraversal& traversal);

  /// The number of visits of leaves that the last call has taken.
  [[nodiscard]] std::size_t visited() const { return visited_; }

  /// Their vertices, ascending by leaf, each leaf once.
  [[nodiscard]] std::span<const LeafSubset> found() const { return found_; }

 private:
  /// Returns the nearest leaf first.
  class NearestFirst {
   public:
    void start(const IndexView& index, const TreeBall& ball);
    void push(LeafId leaf);
    [[nodiscard]] LeafId pop();
    [[nodiscard]] bool empty() const { return heap_.empty(); }
    template <class F>
    void clear(F&& f) {
      for (const auto& [square, leaf] : heap_) f(leaf);
      heap_.clear();
    }

   private:
    const IndexView* index_ = nullptr;
    const TreeBall* ball_ = nullptr;
    std::vector<std::pair<float, LeafId>> heap_;  // squared distance from the query vertex, leaf
  };

  void settle_query_vertex(const Query& query, LeafTraversal& traversal);
  void append_reached(const LeafTraversal& traversal);
  void merge_by_leaf();

  const IndexView* index_;
  const Kernels* kernels_;
  NearestFirst frontier_;
  std::size_t visited_ = 0;
  std::vector<LeafSubset> found_;
};

}  // namespace meshhood
