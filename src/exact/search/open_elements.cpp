// SPDX-License-Identifier: MIT
#include "exact/search/open_elements.h"

#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

NodeSet without(NodeSet nodes, NodeSet others) { return static_cast<NodeSet>(nodes & ~unsigned{others}); }

/// Returns the whole nodes that have no mark.
NodeSet open_nodes(const GroupState& state) { return without(state.whole, state.marked); }

}  // namespace

void OpenElements::unite(Reach& reach, HomeMarks& marks) {
  reach_ = &reach;
  states_ = &reach.states();
  marks_ = &marks;
  sets_.clear();
  sets_.add();  // kMarked, which is the smallest element and so names its set
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
    first_element_[group] = sets_.size();
    for_each_node(open, [&](unsigned) { sets_.add(); });
    for_each_node(open, [&](unsigned i) {
      const auto before = static_cast<NodeSet>(index_->records[group].linked[i] & open & (node_at(i) - 1U));
      for_each_node(before,
                    [&](unsigned k) { sets_.unite(element_of(group * kFanOut + i), element_of(group * kFanOut + k)); });
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
  first_piece_element_ = sets_.size();
  for (std::size_t i = 0; i < pieces_.size(); ++i) sets_.add();
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
    for_each_node(mine, [&](unsigned i) { sets_.unite(element_of(group * kFanOut + i), element_of(other)); });
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
        sets_.unite(mine, kMarked);
      } else if (leaves_.has(link.leaf) != 0) {
        sets_.unite(mine, element_of(states_->whole_node(link.leaf)));
      } else if (const std::size_t place = reach_->place_of(link.leaf); place != Reach::kNoPlace) {
        const LaneMask met = kernels_->cross_edges(index_->cross_edges_of(link), ~LaneMask{0});
        for_each_element(place, met & reach_->surface_leaves()[place].lanes,
                         [&](Element theirs, LaneMask) { sets_.unite(mine, theirs); });
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
    for_each_element(place, link.boundary & lanes, [&](Element mine, LaneMask) { sets_.unite(mine, other); });
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
      for_each_element(other, met, [&](Element theirs, LaneMask) { sets_.unite(mine, theirs); });
    });
  }
}

/// Marks what is in one set with the marked element.
void OpenElements::mark_united() {
  for (const std::uint32_t group : marks_->open_groups()) {
    NodeSet united = 0;
    Element element = first_element_[group];
    for_each_node(open_nodes((*states_)[group]), [&](unsigned i) {
      if (sets_.first_of(element++) == kMarked) united |= node_at(i);
    });
    marks_->add_nodes(group, united);
  }
  for (const std::size_t place : marks_->open_places()) {
    for (std::uint32_t piece = first_piece_[place]; piece < first_piece_[place + 1]; ++piece) {
      if (sets_.first_of(first_piece_element_ + piece) == kMarked) marks_->add_lanes(place, pieces_[piece]);
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

}  // namespace meshhood::inline v0_1
