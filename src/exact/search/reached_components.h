// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"
#include "exact/search/query.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// The connected components of all that the outward search has reached, by union-find. Its elements are the whole nodes
/// and the *pieces* of surface leaves: vertices in the ball that are connected within their leaf. Two elements are
/// united if an edge of the mesh joins them, so the elements of a set are one component of the ball.
///
/// It looks at the links of every node and surface leaf, so it costs more than marks and a few traversals, and less
/// than traversals of much of the ball.
class ReachedComponents {
 public:
  ReachedComponents(const IndexView& index, const Kernels& kernels)
      : index_(&index), kernels_(&kernels), first_(index.records.size()) {}

  /// Adds the component of the query vertex to `answer`, which is empty.
  ///
  /// groups          those of known state, each level from the left to the right
  /// surface_leaves  the leaves that intersect the surface of the ball in the order of `groups`, with their vertices in
  ///                 the ball
  void find(const Query& query, std::span<const std::uint32_t> groups, std::span<const LeafSubset> surface_leaves,
            const GroupStates& states, VertexSet& answer);

 private:
  using Element = std::uint32_t;

  static constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();

  /// Of a group: its first whole node as an element, and its first surface leaf.
  struct First {
    Element whole;
    std::uint32_t surface_leaf;
  };

  void number_nodes(std::span<const std::uint32_t> groups, const GroupStates& states);
  void unite_nodes(std::uint32_t group, const GroupStates& states);
  void cut_leaves(std::span<const LeafSubset> surface_leaves, const GroupStates& states);
  void unite_leaves(std::size_t place, LeafId leaf, const GroupStates& states);
  [[nodiscard]] bool has_other_than(Element home, std::size_t place);
  void add_component(Element home, std::span<const std::uint32_t> groups, std::span<const LeafSubset> surface_leaves,
                     const GroupStates& states, VertexSet& answer);

  [[nodiscard]] Element element_of(NodeId whole, const GroupStates& states) const;
  [[nodiscard]] Element element_at(const Query& query, const GroupStates& states) const;
  [[nodiscard]] std::size_t place_of(LeafId surface_leaf, const GroupStates& states) const;
  template <class F>
  void for_each_piece(std::size_t place, LaneMask touching, F&& f) const;

  Element root_of(Element element);
  void unite(Element a, Element b);

  const IndexView* index_;
  const Kernels* kernels_;
  std::vector<First> first_;          // by group, if its state is known
  std::vector<Element> first_piece_;  // by place of a surface leaf, and one more
  std::vector<LaneMask> pieces_;      // by element, from `node_count_` on
  Element node_count_ = 0;
  std::vector<Element> parents_;  // by element: another of its set, or itself
};

}  // namespace meshhood
