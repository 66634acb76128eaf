// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/node_search.h"
#include "exact/search/query.h"
#include "exact/search/reach.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// A set of leaves as bits, a byte for each group of leaves, to which whole nodes are added. So one look-up tells
/// whether a link leads to one of them, however large the node is that it leads to.
class LeafBits {
 public:
  explicit LeafBits(const IndexView& index) : index_(&index), groups_(index.leaf_count() / kFanOut) {}

  void clear() {
    for (const LeafGroupRange& range : added_) fill(range, 0);
    added_.clear();
  }

  /// Adds the leaves below some nodes of a group.
  void add(std::uint32_t group, NodeSet nodes) {
    if (index_->is_of_leaves(group)) {
      added_.push_back({group, group + 1});
      groups_[group] |= nodes;
    } else {
      for_each_node(nodes, [&](unsigned i) {
        added_.push_back(index_->leaf_groups_of(group * kFanOut + i));
        fill(added_.back(), first_nodes(kFanOut));
      });
    }
  }

  /// 1 if it has the leaf, else 0: for masks without branches, which could not be predicted.
  [[nodiscard]] unsigned has(LeafId leaf) const { return groups_[leaf / kFanOut] >> leaf % kFanOut & 1U; }

  /// The same for the first leaf below a node above the leaves.
  [[nodiscard]] unsigned has_below(NodeId node) const { return groups_[index_->leaf_groups_of(node).begin] & 1U; }

 private:
  void fill(const LeafGroupRange& range, NodeSet value) {
    std::fill(groups_.begin() + range.begin, groups_.begin() + range.end, value);
  }

  const IndexView* index_;
  std::vector<NodeSet> groups_;
  std::vector<LeafGroupRange> added_;
};

/// Marks what is known to be connected with the query vertex within the ball: whole nodes, in `GroupState::home`, and
/// vertices of surface leaves. The marks spread over the links in a few passes. They are never wrong, but may be
/// incomplete: what has no mark then is *open*.
class HomeMarks {
 public:
  HomeMarks(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels), leaves_(index) {}

  void spread(const Query& query, Reach& reach);

  /// Marks some whole nodes of a group, or lanes of a surface leaf, that `spread` has left open.
  void add_nodes(std::uint32_t group, NodeSet nodes) { (*states_)[group].marked |= nodes; }
  void add_lanes(std::size_t place, LaneMask lanes) { lanes_[place] |= lanes; }

  /// The marked lanes of a surface leaf, by its place. `lanes(surface_leaves().size())` may be read, too.
  [[nodiscard]] LaneMask lanes(std::size_t place) const { return lanes_[place]; }

  /// Whether a whole node that `spread` has marked is, or covers, the leaf: 1 or 0.
  [[nodiscard]] unsigned has(LeafId leaf) const { return leaves_.has(leaf); }

  /// The groups with open nodes, in the order of `Reach::groups`; the places of surface leaves with open lanes,
  /// ascending.
  [[nodiscard]] std::span<const std::uint32_t> open_groups() const { return open_groups_; }
  [[nodiscard]] std::span<const std::size_t> open_places() const { return open_places_; }

 private:
  void begin(const Query& query, const Reach& reach);
  void mark_nodes(std::uint32_t group);
  [[nodiscard]] unsigned covers(NodeId node) const;
  void keep_open(std::span<const std::uint32_t> groups);
  void mark_leaf(const Query& query, const LeafSubset& leaf, std::size_t place);

  const IndexView* index_;
  const Kernels* kernels_;
  GroupStates* states_ = nullptr;
  LeafBits leaves_;              // below marked nodes
  std::vector<LaneMask> lanes_;  // by place of a surface leaf, and one more
  std::vector<std::uint32_t> open_groups_;
  std::vector<std::size_t> open_places_;
};

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
  Element root_of(Element element);
  void unite(Element a, Element b);

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
  std::vector<Element> parents_;  // by element: another of its set, or itself
};

/// The component of the query vertex among all that the outward search has reached.
///
/// An edge of the mesh between two vertices reached lies within a whole node, or within a piece of a surface leaf, or
/// is part of a link between two of these. So the component is what links join with the query vertex. Home marks find
/// most of it, and union-find the rest.
class Component {
 public:
  Component(const IndexView& index, const Kernels& kernels)
      : index_(&index), marks_(index, kernels), open_(index, kernels) {}

  /// The first step: marks what is surely connected with the query vertex.
  void mark(const Query& query, Reach& reach) { marks_.spread(query, reach); }

  /// How many surface leaves have vertices in the ball without a mark.
  [[nodiscard]] std::size_t open_leaves() const { return marks_.open_places().size(); }

  /// The second step: completes the marks. Adds the component to `answer`, which is empty.
  void complete(Reach& reach, VertexSet& answer);

 private:
  void add_group(std::uint32_t group, const Reach& reach, std::size_t& place, VertexSet& answer) const;

  const IndexView* index_;
  HomeMarks marks_;
  OpenElements open_;
};

}  // namespace meshhood::inline v0_1
