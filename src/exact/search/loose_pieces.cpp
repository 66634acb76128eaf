// SPDX-License-Identifier: MIT
#include "exact/search/loose_pieces.h"

#include <algorithm>
#include <tuple>

#include "base/distance.h"
#include "exact/node_search.h"
#include "exact/search/prefetch_edges.h"

namespace meshhood {

void LoosePieces::find(const Query& query, std::span<const std::uint32_t> groups,
                       std::span<const LeafSubset> surface_leaves, HomeMarks& marks, GroupStates& states) {
  leaves_.clear();
  minima_.clear();
  leaf_count_ = 0;
  gather_surface_leaves(surface_leaves, states);
  const std::size_t surface = leaves_.size();
  cut_from(0, query, marks, states);
  // Most whole nodes in doubt are marked now.
  gather_whole(groups, query.tree_ball, marks, states);
  cut_from(surface, query, marks, states);
  std::sort(minima_.begin(), minima_.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    return std::tie(a.square, a.leaf, a.lane) < std::tie(b.square, b.leaf, b.lane);  // mutant: farthest-minimum-first
  });
}

void LoosePieces::gather_surface_leaves(std::span<const LeafSubset> surface_leaves, const GroupStates& states) {
  for (const LeafSubset& leaf : surface_leaves) {
    if ((states[leaf.leaf / kFanOut].in_doubt & node_at(leaf.leaf % kFanOut)) != 0) leaves_.push_back(leaf);
  }
}

/// The leaves in doubt below unmarked whole nodes in doubt. Small nodes come first, because their marks spread to the
/// large ones.
void LoosePieces::gather_whole(std::span<const std::uint32_t> groups, const TreeBall& ball, HomeMarks& marks,
                               GroupStates& states) {
  for (std::size_t place = groups.size(); place-- > 0;) {
    const std::uint32_t group = groups[place];
    const GroupState& state = states[group];
    for_each_node(state.whole & state.in_doubt & static_cast<NodeSet>(~state.home), [&](unsigned i) {
      const NodeId node = group * kFanOut + i;
      if (marks.leads_home(node, states) || marks.smaller_leads_home(node, states)) return;
      if (node < index_->leaf_count()) {
        leaves_.push_back({node, first_lanes(index_->leaves[node].size)});
      } else {
        gather_below(index_->records[group].first_child + i, ball);  // mutant: large-unmarked-node-ignored
      }
    });
  }
}

void LoosePieces::gather_below(std::uint32_t group, const TreeBall& ball) {
  GroupContainment found{};
  kernels_->classify(index_->groups.data(), std::span(&group, 1), ball, &found);
  const GroupRecord& record = index_->records[group];
  for_each_node(found.may_have_minimum & first_nodes(record.nodes), [&](unsigned i) {
    const NodeId node = group * kFanOut + i;
    if (node < index_->leaf_count()) {
      leaves_.push_back({node, first_lanes(index_->leaves[node].size)});
    } else {
      gather_below(record.first_child + i, ball);
    }
  });
}

void LoosePieces::cut_from(std::size_t first, const Query& query, HomeMarks& marks, GroupStates& states) {
  for (std::size_t i = first; i < leaves_.size(); ++i) {  // mutant: first-leaf-in-doubt-ignored
    prefetch_edges_ahead(*index_, leaves_, i);
    // Another leaf below the same whole node may have marked it.
    if (states.is_home(leaves_[i].leaf)) continue;
    cut(leaves_[i], query, marks, states);
    ++leaf_count_;
  }
}

/// Cuts the vertices of a leaf that are in the ball into connected pieces, and tests the nearest vertex of each that is
/// loose. Other vertices of a piece have a nearer one in their component.
void LoosePieces::cut(const LeafSubset& leaf, const Query& query, HomeMarks& marks, GroupStates& states) {
  const Leaf& record = index_->leaves[leaf.leaf];
  const LaneMask query_lane = query.leaf() == leaf.leaf ? query.lane() : 0;
  for (LaneMask left = leaf.lanes; left != 0;) {
    const bool is_whole = record.connected && left == first_lanes(record.size);
    const LaneMask piece = is_whole ? left : kernels_->reachable(&index_->adjacency[record.first], left, left & -left);
    left &= ~piece;
    if ((piece & query_lane) != 0 || touches_home(leaf.leaf, piece, marks, states)) {
      marks.mark(leaf.leaf, states);
      continue;
    }
    const Nearest nearest = kernels_->nearest(index_->positions, record.first, piece, query.ball);
    const LocalMinimum vertex{nearest.square, leaf.leaf, nearest.lane};
    if (!has_nearer_neighbor(vertex, query.center())) minima_.push_back(vertex);
  }
}

bool LoosePieces::touches_home(LeafId leaf, LaneMask piece, HomeMarks& marks, GroupStates& states) const {
  const std::span<const Link> links = index_->links_of(leaf);
  return std::any_of(links.begin(), links.end(), [&](const Link& link) {
    const bool is_met = (link.boundary & piece) != 0;      // mutant: link-of-another-piece
    return is_met && marks.leads_home(link.leaf, states);  // mutant: unmarked-node-taken-as-home
  });
}

bool LoosePieces::has_nearer_neighbor(const LocalMinimum& vertex, const Point& center) const {
  for (const Link& link : index_->links_of(vertex.leaf)) {
    if ((link.boundary >> vertex.lane & 1U) == 0) continue;
    for (const CrossEdge& edge : index_->cross_edges_of(link)) {
      if (edge.from != vertex.lane) continue;  // mutant: cross-edges-of-every-lane
      // mutant: tied-neighbor-taken-as-nearer
      if (squared_distance(index_->position(link.leaf, edge.to), center) < vertex.square) return true;
    }
  }
  return false;
}

}  // namespace meshhood
