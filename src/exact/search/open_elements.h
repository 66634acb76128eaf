// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/home_marks.h"
#include "exact/search/reach.h"
#include "shared/disjoint_sets.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Completes the home marks by union-find over the open elements: whole nodes without a mark, and pieces without one,
/// which are vertices of a surface leaf in the ball that are connected within the leaf. All that is marked is one more
/// element. Two elements are united if an edge of the mesh joins them. What is then united with the marked element is
/// marked. docs/design.md says why no link is missed.
///
/// A link between nodes is listed at both if they are of one level; and a node sees a larger one that covers the other
/// end of its link. It does not see smaller ones, so these are visited instead (`unite_beside`). Home marks need no
/// such visit: within a group, and from a surface leaf, all that is linked with a mark has one.
class OpenElements {
 public:
  OpenElements(const IndexView& index, const Kernels& kernels)
      : index_(&index), kernels_(&kernels), leaves_(index), first_element_(index.records.size()) {}

  void unite(Reach& reach, HomeMarks& marks);

 private:
  using Element = std::uint32_t;

  static constexpr Element kMarked = 0;

  void number_nodes();
  void cut_leaves();
  void unite_nodes(std::uint32_t group);
  void unite_beside(std::uint32_t group);
  void unite_below(std::uint32_t group);
  void unite_whole_leaves(std::uint32_t group);
  void unite_with_nodes(std::size_t place);
  void unite_with_leaves(std::size_t place);
  void mark_united();

  [[nodiscard]] Element element_of(NodeId whole) const;
  template <class F>
  void for_each_element(std::size_t place, LaneMask lanes, F&& f) const;

  const IndexView* index_;
  const Kernels* kernels_;
  Reach* reach_ = nullptr;
  GroupStates* states_ = nullptr;
  HomeMarks* marks_ = nullptr;
  LeafBits leaves_;                     // below open nodes
  std::vector<Element> first_element_;  // by group with open nodes: the element of the first of them
  std::vector<LaneMask> pieces_;
  std::vector<std::uint32_t> first_piece_;  // by place of a surface leaf, and one more
  Element first_piece_element_ = 0;
  DisjointSets sets_;  // of the elements
};

}  // namespace meshhood::inline v0_1
