// SPDX-License-Identifier: MIT
#include "exact/search/leaf_bfs.h"

#include <algorithm>
#include <limits>

namespace meshhood {

void LeafBfs::Queue::start(const LeafTraversal& traversal, std::size_t most_prefetched) {
  traversal_ = &traversal;
  leaves_.clear();
  head_ = 0;
  prefetched_ = 0;
  most_prefetched_ = most_prefetched;
}

LeafId LeafBfs::Queue::pop() {
  constexpr std::size_t kLeavesAhead = 12;  // this one included
  const std::size_t soon = std::min({head_ + kLeavesAhead, leaves_.size(), most_prefetched_});
  for (; prefetched_ < soon; ++prefetched_) {
    traversal_->prefetch_neighbors(leaves_[prefetched_]);
    traversal_->prefetch_cross_edges(leaves_[prefetched_]);
  }
  return leaves_[head_++];
}

void LeafBfs::run(const Query& query, bool is_small, LeafTraversal& traversal, VertexSet& answer) {
  traversal.start(query);
  queue_.start(traversal, is_small ? 1 : std::numeric_limits<std::size_t>::max());
  visits_ = 0;
  const auto count = [this](LeafId, LaneMask) {
    ++visits_;
    return false;
  };
  static_cast<void>(traversal.traverse(query.leaf(), query.lane(), queue_, count));
  for (const LeafId leaf : traversal.reached_leaves()) {
    const Leaf& record = index_->leaves[leaf];
    const LaneMask lanes = traversal.reached(leaf);
    if (lanes == first_lanes(record.size)) {  // mutant: leaf-full-without-first-lane
      answer.add(VertexRange{static_cast<VertexId>(record.first), static_cast<VertexId>(record.first + record.size)});
    } else {
      answer.add(LeafSubset{leaf, lanes});
    }
  }
}

}  // namespace meshhood
