// SPDX-License-Identifier: MIT
#include "exact/search/other_components.h"

#include <algorithm>
#include <functional>

namespace meshhood {

void OtherComponents::NearestFirst::start(const IndexView& index, const TreeBall& ball) {
  index_ = &index;
  ball_ = &ball;
}

void OtherComponents::NearestFirst::push(LeafId leaf) {
  const FrameSphere& bounds = index_->leaves[leaf].bounds;
  const float x = bounds.x - ball_->x;
  const float y = bounds.y - ball_->y;
  const float z = bounds.z - ball_->z;
  heap_.emplace_back((x * x + y * y) + z * z, leaf);
  std::push_heap(heap_.begin(), heap_.end(), std::greater());
}

LeafId OtherComponents::NearestFirst::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), std::greater());
  const LeafId leaf = heap_.back().second;
  heap_.pop_back();
  return leaf;
}

bool OtherComponents::find(const Query& query, std::span<const LocalMinimum> minima, HomeMarks& marks,
                           GroupStates& states, std::size_t most_visited, LeafTraversal& traversal) {
  found_.clear();
  visited_ = 0;
  if (minima.empty()) return true;  // mutant: one-minimum-ignored
  traversal.start(query);
  frontier_.start(*index_, query.tree_ball);
  settle_query_vertex(query, traversal);
  for (const LocalMinimum& minimum : minima) {
    const LaneMask lane = LaneMask{1} << minimum.lane;
    if (traversal.is_settled(minimum.leaf, lane)) continue;
    const auto is_known = [&](LeafId leaf, LaneMask added) {
      if (++visited_ > most_visited || marks.leads_home(leaf, states)) return true;
      const std::uint32_t first = index_->leaves[leaf].first;
      return kernels_->nearest(index_->positions, first, added, query.ball).square < minimum.square;
    };
    const bool is_other_component = traversal.traverse(minimum.leaf, lane, frontier_, is_known);
    if (visited_ > most_visited) return false;
    if (is_other_component) append_reached(traversal);  // mutant: other-components-kept
    traversal.settle();
  }
  merge_by_leaf();
  return true;
}

/// Settles the vertices that are connected with the query vertex within its leaf.
void OtherComponents::settle_query_vertex(const Query& query, LeafTraversal& traversal) {
  const auto at_once = [](LeafId, LaneMask) { return true; };
  static_cast<void>(traversal.traverse(query.leaf(), query.lane(), frontier_, at_once));
  traversal.settle();
}

void OtherComponents::append_reached(const LeafTraversal& traversal) {
  for (const LeafId leaf : traversal.reached_leaves()) found_.push_back({leaf, traversal.reached(leaf)});
}

/// Two components may have vertices in one leaf.
void OtherComponents::merge_by_leaf() {
  std::sort(found_.begin(), found_.end(), [](const LeafSubset& a, const LeafSubset& b) { return a.leaf < b.leaf; });
  std::size_t kept = 0;
  for (const LeafSubset& next : found_) {
    if (kept != 0 && found_[kept - 1].leaf == next.leaf) {
      found_[kept - 1].lanes |= next.lanes;
    } else {
      found_[kept++] = next;
    }
  }
  found_.resize(kept);
}

}  // namespace meshhood
