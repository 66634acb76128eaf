// SPDX-License-Identifier: MIT
#include "exact/search/leaf_bfs.h"

#include <algorithm>

#include "exact/search/small_ball.h"

namespace meshhood {
namespace {

// How many leaves of the queue, the present one included, have their neighbours fetched.
constexpr std::size_t kLeavesAhead = 12;

}  // namespace

void LeafBfs::run(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk,
                  VertexSet& answer) {
  queue_.clear();
  reached_.clear();
  walk.start(ball, tree_ball);
  const LeafId first = leaf_of(slot);
  walk.touch(first).pending = LaneMask{1} << lane_of(slot);
  queue_.push_back(first);
  walk.fetch_cross_edges(first);
  const std::size_t fetched_at_most = is_small(tree_ball, *index_) ? 1 : queue_.max_size();
  std::size_t fetched = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::size_t soon = std::min({head + kLeavesAhead, queue_.size(), fetched_at_most});
    for (; fetched < soon; ++fetched) walk.fetch_neighbors(queue_[fetched]);
    const LeafId leaf = queue_[head];
    const bool is_new = walk.find(leaf)->reached == 0;
    const LaneMask added = walk.reach(leaf);
    if (added == 0) continue;
    if (is_new) reached_.push_back(leaf);  // mutant: leaf-reached-twice
    walk.push_on(leaf, added, queue_);
  }
  append_to(walk, answer);
}

void LeafBfs::append_to(const LeafTraversal& walk, VertexSet& answer) const {
  for (const LeafId leaf : reached_) {
    const Leaf& record = index_->leaves[leaf];
    const LaneMask lanes = walk.find(leaf)->reached;
    if (lanes == first_lanes(record.size)) {  // mutant: leaf-full-without-first-lane
      answer.runs.push_back({static_cast<VertexId>(record.first), static_cast<VertexId>(record.first + record.size)});
    } else {
      answer.subsets.push_back({leaf, lanes});
    }
  }
}

}  // namespace meshhood
