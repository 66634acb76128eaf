// SPDX-License-Identifier: MIT
#include "exact/search/reached_components.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "exact/node_search.h"
#include "exact/search/prefetch_edges.h"

namespace meshhood {
namespace {

/// The number of nodes of `set` before a place.
std::uint32_t count_before(NodeSet set, unsigned place) {
  return static_cast<std::uint32_t>(std::popcount(set & ((1U << place) - 1U)));
}

}  // namespace

void ReachedComponents::find(const Query& query, std::span<const std::uint32_t> groups,
                             std::span<const LeafSubset> surface_leaves, const GroupStates& states, VertexSet& answer) {
  number_nodes(groups, states);
  for (const std::uint32_t group : groups) unite_nodes(group, states);
  cut_leaves(surface_leaves, states);
  // Nearly all elements now belong to the set of `home`. An edge between two surface leaves matters only if one of them
  // does not.
  const Element home = element_at(query, states);
  for (std::size_t i = 0; i < surface_leaves.size(); ++i) {
    if (has_other_than(home, i)) unite_leaves(i, surface_leaves[i].leaf, states);  // mutant: leaves-not-united
  }
  add_component(root_of(home), groups, surface_leaves, states, answer);
}

void ReachedComponents::number_nodes(std::span<const std::uint32_t> groups, const GroupStates& states) {
  const std::size_t leaf_groups = index_->leaf_count() / kFanOut;
  First next{0, 0};
  for (const std::uint32_t group : groups) {
    first_[group] = next;
    next.whole += static_cast<Element>(std::popcount(states[group].whole));
    if (group < leaf_groups) next.surface_leaf += static_cast<std::uint32_t>(std::popcount(states[group].intersecting));
  }
  node_count_ = next.whole;
  parents_.resize(node_count_);
  std::iota(parents_.begin(), parents_.end(), Element{0});
}

/// Unites the whole nodes of a group with those that their links lead to: of their own level, or larger ones that cover
/// such a node. The others of a link are smaller, and do so themselves.
void ReachedComponents::unite_nodes(std::uint32_t group, const GroupStates& states) {
  const NodeSet whole = states[group].whole;
  if (whole == 0) return;
  const GroupRecord& record = index_->records[group];
  for_each_node(whole, [&](unsigned i) {
    const auto before = static_cast<NodeSet>(record.linked[i] & whole & ((1U << i) - 1U));
    for_each_node(before, [&](unsigned k) {
      unite(first_[group].whole + count_before(whole, i), first_[group].whole + count_before(whole, k));
    });
  });
  for (const NodeLink& link : index_->node_links_of(record)) {
    const auto mine = static_cast<NodeSet>(link.mine & whole);
    if (mine == 0) continue;
    const NodeId other = states.whole_node(link.node());
    // Nodes of one level have a link in both groups.
    // mutant: larger-nodes-not-united
    if (other == kNoNode || (other == link.node() && other / kFanOut > group)) continue;
    const Element element = element_of(other, states);
    for_each_node(mine, [&](unsigned i) { unite(first_[group].whole + count_before(whole, i), element); });
  }
}

/// Cuts the leaves into pieces, and unites these with whole nodes.
void ReachedComponents::cut_leaves(std::span<const LeafSubset> surface_leaves, const GroupStates& states) {
  pieces_.clear();
  first_piece_.assign(1, node_count_);
  for (std::size_t i = 0; i < surface_leaves.size(); ++i) {
    prefetch_edges_ahead(*index_, surface_leaves, i);
    const auto [leaf, lanes] = surface_leaves[i];
    const LaneMask* adjacency = &index_->adjacency[index_->leaves[leaf].first];
    for (LaneMask left = lanes; left != 0; left &= ~pieces_.back()) {
      pieces_.push_back(kernels_->reachable(adjacency, left, left & -left));
      parents_.push_back(static_cast<Element>(parents_.size()));
    }
    first_piece_.push_back(static_cast<Element>(parents_.size()));
    for (const Link& link : index_->links_of(leaf)) {
      const NodeId whole = (link.boundary & lanes) != 0 ? states.whole_node(link.leaf) : kNoNode;
      if (whole == kNoNode) continue;
      for_each_piece(i, link.boundary, [&](Element piece, LaneMask) { unite(piece, element_of(whole, states)); });
    }
  }
}

/// Unites the pieces of a surface leaf with those of the surface leaves that it is linked with.
void ReachedComponents::unite_leaves(std::size_t place, LeafId leaf, const GroupStates& states) {
  for (const Link& link : index_->links_of(leaf)) {
    const std::size_t other = place_of(link.leaf, states);
    if (other == kNoPlace) continue;
    for_each_piece(place, link.boundary, [&](Element piece, LaneMask lanes) {
      const LaneMask met = kernels_->cross_edges(index_->cross_edges_of(link), lanes);
      for_each_piece(other, met, [&](Element theirs, LaneMask) { unite(piece, theirs); });
    });
  }
}

/// Whether a piece of the surface leaf is not known to belong to the set of `home`.
bool ReachedComponents::has_other_than(Element home, std::size_t place) {
  bool result = false;
  for_each_piece(place, ~LaneMask{0}, [&](Element piece, LaneMask) { result |= root_of(piece) != root_of(home); });
  return result;
}

void ReachedComponents::add_component(Element home, std::span<const std::uint32_t> groups,
                                      std::span<const LeafSubset> surface_leaves, const GroupStates& states,
                                      VertexSet& answer) {
  for (const std::uint32_t group : groups) {
    Element element = first_[group].whole;
    for_each_node(states[group].whole, [&](unsigned i) {
      if (root_of(element++) == home) answer.add(run_of(index_->records[group], i));
    });
  }
  for (std::size_t i = 0; i < surface_leaves.size(); ++i) {
    LaneMask lanes = 0;
    for_each_piece(i, surface_leaves[i].lanes, [&](Element piece, LaneMask mine) {
      if (root_of(piece) == home) lanes |= mine;  // mutant: pieces-of-other-components-kept
    });
    if (lanes != 0) answer.add(LeafSubset{surface_leaves[i].leaf, lanes});
  }
}

ReachedComponents::Element ReachedComponents::element_of(NodeId whole, const GroupStates& states) const {
  const std::uint32_t group = whole / kFanOut;
  return first_[group].whole + count_before(states[group].whole, whole % kFanOut);
}

/// The element of the query vertex.
ReachedComponents::Element ReachedComponents::element_at(const Query& query, const GroupStates& states) const {
  const NodeId whole = states.whole_node(query.leaf());
  if (whole != kNoNode) return element_of(whole, states);
  Element result = 0;
  for_each_piece(place_of(query.leaf(), states), query.lane(), [&](Element piece, LaneMask) { result = piece; });
  return result;
}

/// The place of a leaf among the surface leaves, or `kNoPlace`.
std::size_t ReachedComponents::place_of(LeafId leaf, const GroupStates& states) const {
  const std::uint32_t group = leaf / kFanOut;
  const NodeSet intersecting = states.is_known(group) ? states[group].intersecting : NodeSet{0};
  if ((intersecting >> leaf % kFanOut & 1U) == 0) return kNoPlace;
  return first_[group].surface_leaf + count_before(intersecting, leaf % kFanOut);
}

/// Calls `f(element, lanes)` for the pieces of a surface leaf that have some of the lanes `touching`.
template <class F>
void ReachedComponents::for_each_piece(std::size_t place, LaneMask touching, F&& f) const {
  for (Element piece = first_piece_[place]; piece < first_piece_[place + 1]; ++piece) {
    const LaneMask lanes = pieces_[piece - node_count_];
    if ((lanes & touching) != 0) f(piece, lanes);
  }
}

/// Shortens the path to the root on the way.
ReachedComponents::Element ReachedComponents::root_of(Element element) {
  while (parents_[element] != element) element = parents_[element] = parents_[parents_[element]];
  return element;
}

/// The smaller number becomes the root, so that the result does not depend on the order.
void ReachedComponents::unite(Element a, Element b) {
  a = root_of(a);
  b = root_of(b);
  parents_[std::max(a, b)] = std::min(a, b);
}

}  // namespace meshhood
