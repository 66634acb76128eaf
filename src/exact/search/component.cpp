// SPDX-License-Identifier: MIT
#include "exact/search/component.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

NodeSet without(NodeSet nodes, NodeSet others) { return static_cast<NodeSet>(nodes & ~unsigned{others}); }

/// The whole nodes that have no mark.
NodeSet open_nodes(const GroupState& state) { return without(state.whole, state.marked); }

}  // namespace

void HomeMarks::spread(const Query& query, Reach& reach) {
  states_ = &reach.states();
  leaves_.clear();
  begin(query, reach);
  for (const std::uint32_t group : reach.top_groups()) mark_nodes(group);
  for (const std::uint32_t group : reach.lower_groups()) mark_nodes(group);
  // A group sees the marks of those before it only. Chosen: a fourth pass would find few more.
  keep_open(reach.groups());
  for (int pass = 0; pass < 2; ++pass) {
    for (const std::uint32_t group : open_groups_) mark_nodes(group);
    keep_open(open_groups_);
  }
  const std::span<const LeafSubset> leaves = reach.surface_leaves();
  lanes_.resize(leaves.size() + 1);
  open_places_.clear();
  for (std::size_t place = 0; place < leaves.size(); ++place) mark_leaf(query, leaves[place], place);
}

/// Marks the whole nodes at the query vertex.
void HomeMarks::begin(const Query& query, const Reach& reach) {
  const auto mark = [&](LeafId leaf) {
    const NodeId whole = states_->whole_node(leaf);
    if (whole != kNoNode) (*states_)[whole / kFanOut].marked |= node_at(whole % kFanOut);
  };
  mark(query.leaf());
  const std::size_t place = reach.place_of(query.leaf());
  if (place == Reach::kNoPlace) return;
  const LaneMask* adjacency = &index_->adjacency[index_->leaves[query.leaf()].first];
  const LaneMask piece = kernels_->reachable(adjacency, reach.surface_leaves()[place].lanes, query.lane());
  for (const Link& link : index_->links_of(query.leaf())) {
    if ((link.boundary & piece) != 0) mark(link.leaf);
  }
}

/// Spreads the marks to the whole nodes of a group, from its own and from those that its links lead to: nodes of the
/// same level, or larger ones that cover them.
void HomeMarks::mark_nodes(std::uint32_t group) {
  GroupState& state = (*states_)[group];
  if (state.whole == 0) return;
  const GroupRecord& record = index_->records[group];
  unsigned linked = state.marked;
  if (index_->is_of_leaves(group)) {
    for (const NodeLink& link : index_->node_links_of(record)) linked |= link.mine & (0U - leaves_.has(link.node()));
  } else {
    for (const NodeLink& link : index_->node_links_of(record)) linked |= link.mine & (0U - covers(link.node()));
  }
  state.marked = reachable_nodes(record.linked, static_cast<NodeSet>(linked & state.whole), state.whole);
  leaves_.add(group, state.marked);
}

/// Whether a node above the leaves, or a larger one that covers it, has a mark: 1 or 0.
unsigned HomeMarks::covers(NodeId node) const {
  // A node of a known group may have marks below it that are not its own.
  if (states_->is_known(node / kFanOut)) return (*states_)[node / kFanOut].marked >> node % kFanOut & 1U;
  return leaves_.has_below(node);
}

/// Keeps those of `groups` that have whole nodes without a mark.
void HomeMarks::keep_open(std::span<const std::uint32_t> groups) {
  if (open_groups_.size() < groups.size()) open_groups_.resize(groups.size());
  std::size_t kept = 0;
  for (const std::uint32_t group : groups) {
    open_groups_[kept] = group;
    kept += static_cast<std::size_t>((*states_)[group].whole != (*states_)[group].marked);
  }
  open_groups_.resize(kept);
}

/// Marks the vertices of a surface leaf that are connected with a marked node within the leaf.
void HomeMarks::mark_leaf(const Query& query, const LeafSubset& leaf, std::size_t place) {
  LaneMask linked = leaf.leaf == query.leaf() ? query.lane() : 0;
  for (const Link& link : index_->links_of(leaf.leaf)) linked |= link.boundary & (0U - leaves_.has(link.leaf));
  linked &= leaf.lanes;
  if (linked != 0 && linked != leaf.lanes) {
    linked = kernels_->reachable(&index_->adjacency[index_->leaves[leaf.leaf].first], leaf.lanes, linked);
  }
  lanes_[place] = linked;
  if (linked != leaf.lanes) open_places_.push_back(place);
}

void OpenElements::unite(Reach& reach, HomeMarks& marks) {
  reach_ = &reach;
  states_ = &reach.states();
  marks_ = &marks;
  parents_.assign(1, kMarked);
  number_nodes();
  cut_leaves();
  for (const std::uint32_t group : marks.open_groups()) {
    if (index_->is_of_leaves(group)) {
      unite_whole_leaves(group);
    } else {
      unite_nodes(group);
      unite_beside(group);
    }
  }
  for (const std::size_t place : marks.open_places()) unite_with_leaves(place);
  mark_united();
}

void OpenElements::number_nodes() {
  leaves_.clear();
  for (const std::uint32_t group : marks_->open_groups()) {
    const NodeSet open = open_nodes((*states_)[group]);
    leaves_.add(group, open);
    first_element_[group] = static_cast<Element>(parents_.size());
    for_each_node(open, [&](unsigned) { parents_.push_back(static_cast<Element>(parents_.size())); });
    for_each_node(open, [&](unsigned i) {
      const auto before = static_cast<NodeSet>(index_->records[group].linked[i] & open & (node_at(i) - 1U));
      for_each_node(before,
                    [&](unsigned k) { unite(element_of(group * kFanOut + i), element_of(group * kFanOut + k)); });
    });
  }
}

/// Cuts the open lanes of surface leaves into pieces.
void OpenElements::cut_leaves() {
  const std::span<const LeafSubset> leaves = reach_->surface_leaves();
  pieces_.clear();
  first_piece_.clear();
  for (const std::size_t place : marks_->open_places()) {
    first_piece_.resize(place + 1, static_cast<std::uint32_t>(pieces_.size()));
    const LaneMask* adjacency = &index_->adjacency[index_->leaves[leaves[place].leaf].first];
    for (LaneMask left = leaves[place].lanes & ~marks_->lanes(place); left != 0; left &= ~pieces_.back()) {
      pieces_.push_back(kernels_->reachable(adjacency, left, left & -left));
    }
  }
  first_piece_.resize(leaves.size() + 1, static_cast<std::uint32_t>(pieces_.size()));
  first_piece_element_ = static_cast<Element>(parents_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) parents_.push_back(static_cast<Element>(parents_.size()));
}

/// Unites the whole nodes of a group with those that their links lead to, of the same level or larger.
void OpenElements::unite_nodes(std::uint32_t group) {
  const GroupState& state = (*states_)[group];
  if (state.whole == 0) return;
  for (const NodeLink& link : index_->node_links_of(index_->records[group])) {
    const auto mine = static_cast<NodeSet>(link.mine & state.whole);
    if (mine == 0) continue;
    const NodeId other = states_->whole_node(link.node());
    if (other == kNoNode) continue;
    for_each_node(mine, [&](unsigned i) { unite(element_of(group * kFanOut + i), element_of(other)); });
  }
}

/// Unites the open nodes of a group with smaller elements: those below the nodes that intersect the ball beside them.
void OpenElements::unite_beside(std::uint32_t group) {
  const GroupState& state = (*states_)[group];
  const GroupRecord& record = index_->records[group];
  const NodeSet open = open_nodes(state);
  unsigned linked = 0;
  for_each_node(open, [&](unsigned i) { linked |= record.linked[i]; });
  for_each_node(static_cast<NodeSet>(linked & state.intersecting),
                [&](unsigned i) { unite_below(record.first_child + i); });
  for (const NodeLink& link : index_->node_links_of(record)) {
    const std::uint32_t other = link.node() / kFanOut;
    const unsigned place = link.node() % kFanOut;
    if ((link.mine & open) == 0 || !states_->is_known(other)) continue;
    if (((*states_)[other].intersecting & node_at(place)) == 0) continue;
    unite_below(index_->records[other].first_child + place);
  }
}

/// Unites what was reached in a group and below with the larger whole nodes beside it.
void OpenElements::unite_below(std::uint32_t group) {
  GroupState& state = (*states_)[group];
  if (state.is_united) return;
  state.is_united = true;
  unite_nodes(group);
  for_each_node(state.intersecting, [&](unsigned i) {
    if (index_->is_of_leaves(group)) {
      unite_with_nodes(reach_->place_of(group * kFanOut + i));
    } else {
      unite_below(index_->records[group].first_child + i);
    }
  });
}

/// Unites the open leaves of a group, which are whole nodes, with all that their links lead to.
void OpenElements::unite_whole_leaves(std::uint32_t group) {
  for_each_node(open_nodes((*states_)[group]), [&](unsigned i) {
    const Element mine = element_of(group * kFanOut + i);
    for (const Link& link : index_->links_of(group * kFanOut + i)) {
      if (marks_->has(link.leaf) != 0) {
        unite(mine, kMarked);
      } else if (leaves_.has(link.leaf) != 0) {
        unite(mine, element_of(states_->whole_node(link.leaf)));
      } else if (const std::size_t place = reach_->place_of(link.leaf); place != Reach::kNoPlace) {
        const LaneMask met = kernels_->cross_edges(index_->cross_edges_of(link), ~LaneMask{0});
        for_each_element(place, met & reach_->surface_leaves()[place].lanes,
                         [&](Element theirs, LaneMask) { unite(mine, theirs); });
      }
    }
  });
}

/// Unites the elements of a surface leaf with the open nodes that its links lead to.
void OpenElements::unite_with_nodes(std::size_t place) {
  const auto [leaf, lanes] = reach_->surface_leaves()[place];
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & lanes) == 0 || leaves_.has(link.leaf) == 0) continue;
    const Element other = element_of(states_->whole_node(link.leaf));
    for_each_element(place, link.boundary & lanes, [&](Element mine, LaneMask) { unite(mine, other); });
  }
}

/// Unites the pieces of a surface leaf with the elements of other surface leaves.
void OpenElements::unite_with_leaves(std::size_t place) {
  const std::span<const LeafSubset> leaves = reach_->surface_leaves();
  const LaneMask open = leaves[place].lanes & ~marks_->lanes(place);
  for (const Link& link : index_->links_of(leaves[place].leaf)) {
    if ((link.boundary & open) == 0) continue;
    const std::size_t other = reach_->place_of(link.leaf);
    if (other == Reach::kNoPlace) continue;
    for_each_element(place, link.boundary & open, [&](Element mine, LaneMask piece) {
      const LaneMask met = kernels_->cross_edges(index_->cross_edges_of(link), piece) & leaves[other].lanes;
      for_each_element(other, met, [&](Element theirs, LaneMask) { unite(mine, theirs); });
    });
  }
}

/// Marks what is in one set with the marked element.
void OpenElements::mark_united() {
  for (const std::uint32_t group : marks_->open_groups()) {
    NodeSet united = 0;
    Element element = first_element_[group];
    for_each_node(open_nodes((*states_)[group]), [&](unsigned i) {
      if (root_of(element++) == kMarked) united |= node_at(i);
    });
    marks_->add_nodes(group, united);
  }
  for (const std::size_t place : marks_->open_places()) {
    for (std::uint32_t piece = first_piece_[place]; piece < first_piece_[place + 1]; ++piece) {
      if (root_of(first_piece_element_ + piece) == kMarked) marks_->add_lanes(place, pieces_[piece]);
    }
  }
}

OpenElements::Element OpenElements::element_of(NodeId whole) const {
  const GroupState& state = (*states_)[whole / kFanOut];
  const NodeSet open = open_nodes(state);
  const NodeSet node = node_at(whole % kFanOut);
  if ((open & node) == 0) return kMarked;
  return first_element_[whole / kFanOut] + static_cast<Element>(count_of(open & (node - 1U)));
}

/// Calls `f(element, lanes)` for the elements that have some of the lanes `touching` of a surface leaf.
template <class F>
void OpenElements::for_each_element(std::size_t place, LaneMask touching, F&& f) const {
  if ((marks_->lanes(place) & touching) != 0) f(kMarked, marks_->lanes(place));
  for (std::uint32_t piece = first_piece_[place]; piece < first_piece_[place + 1]; ++piece) {
    if ((pieces_[piece] & touching) != 0) f(first_piece_element_ + piece, pieces_[piece]);
  }
}

/// Shortens the path to the root on the way.
OpenElements::Element OpenElements::root_of(Element element) {
  while (parents_[element] != element) element = parents_[element] = parents_[parents_[element]];
  return element;
}

/// The smaller number becomes the root, so that the set of all that is marked has the root `kMarked`.
void OpenElements::unite(Element a, Element b) {
  a = root_of(a);
  b = root_of(b);
  parents_[std::max(a, b)] = std::min(a, b);
}

void Component::complete(Reach& reach, VertexSet& answer) {
  if (!marks_.open_groups().empty() || !marks_.open_places().empty()) open_.unite(reach, marks_);
  answer.make_room(kFanOut * reach.groups().size());
  std::size_t place = 0;
  for (const std::uint32_t group : reach.groups().first(reach.top_groups().size())) {
    add_group(group, reach, place, answer);
  }
}

/// Adds what a group has of the component in index order. `place` is that of the next surface leaf.
void Component::add_group(std::uint32_t group, const Reach& reach, std::size_t& place, VertexSet& answer) const {
  const GroupState& state = reach.states()[group];
  const GroupRecord& record = index_->records[group];
  for_each_node(static_cast<NodeSet>(state.marked | state.intersecting), [&](unsigned i) {
    const unsigned is_marked = state.marked >> i & 1U;
    if (index_->is_of_leaves(group)) {
      // Without branches, which could not be predicted.
      const LaneMask lanes = marks_.lanes(place) & (is_marked - 1U);
      answer.add_if(is_marked != 0 || lanes != 0, run_of(record, i), lanes);
      place += 1U - is_marked;
    } else if (is_marked != 0) {
      answer.add(run_of(record, i));
    } else {
      add_group(record.first_child + i, reach, place, answer);
    }
  });
}

}  // namespace meshhood::inline v0_1
