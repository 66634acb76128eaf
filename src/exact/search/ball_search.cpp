// SPDX-License-Identifier: MIT
#include "exact/search/ball_search.h"

#include <algorithm>
#include <tuple>

#include "base/prefetch.h"
#include "exact/search/fetch.h"
#include "exact/search/local_minimum.h"
#include "exact/search/output.h"
#include "exact/search/small_ball.h"

namespace meshhood {
namespace {

// What may be spent, in leaves, before a flood of all the leaves in the ball is the shorter way.
std::size_t most_candidates(std::size_t leaves) { return std::min(leaves, 16 + leaves / 4); }
std::size_t most_walked(std::size_t leaves) { return std::min(leaves / 2, 16 + leaves / 10); }

bool are_linked(const IndexView& index, LeafId a, LeafId b) {
  const std::span<const Link> links = index.links_of(a);
  return std::any_of(links.begin(), links.end(), [b](const Link& link) { return link.leaf == b; });
}

}  // namespace

bool BallSearch::run(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk,
                     VertexSet& answer) {
  const auto radius = static_cast<double>(tree_ball.inner);
  const LeafId home = leaf_of(slot);
  if (is_small(tree_ball, *index_) || !failures_.should_try(home, radius)) return false;
  const bool found = find(slot, ball, tree_ball, walk, answer);
  failures_.record(home, radius, found);
  if (!found) answer.clear();  // mutant: failed-search-leaves-answer
  return found;
}

bool BallSearch::find(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk,
                      VertexSet& answer) {
  if (!descent_.run(tree_ball, answer.runs)) return false;
  const std::size_t leaves = count(answer) / kLeafCapacity + descent_.intersecting_leaves().size();
  if (descent_.candidate_leaves().size() > most_candidates(leaves)) return false;
  collect_minima(slot, ball, tree_ball);
  const bool is_whole_ball = minima_.empty();  // mutant: one-minimum-ignored
  if (!is_whole_ball && !other_components_.find(slot, minima_, most_walked(leaves), ball, tree_ball, walk)) {
    return false;
  }
  append_intersecting(ball, answer.subsets);
  if (!is_whole_ball) other_components_.cut_from(answer);
  return true;
}

void BallSearch::collect_minima(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball) {
  minima_.clear();
  const LeafId home = leaf_of(slot);
  const bool home_is_whole = is_whole(home, tree_ball);
  const std::span<const std::uint32_t> leaves = descent_.candidate_leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {  // mutant: first-candidate-ignored
    fetch_ahead(leaves.subspan(i));
    const LeafId leaf = leaves[i];
    // The leaves around the query vertex always look may_have_minimum, but mostly hang together with it as they are.
    if (home_is_whole && (leaf == home || (are_linked(*index_, home, leaf) && is_whole(leaf, tree_ball)))) continue;
    append_local_minima(*index_, *kernels_, leaf, slot, ball, minima_);
  }
  std::sort(minima_.begin(), minima_.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    return std::tie(a.square, a.leaf, a.lane) < std::tie(b.square, b.leaf, b.lane);
  });
}

/// What `append_local_minima` will look at in the next of `leaves`; each step needs what an earlier one has fetched.
void BallSearch::fetch_ahead(std::span<const std::uint32_t> leaves) const {
  constexpr std::size_t kRecord = 9;
  constexpr std::size_t kContents = 6;
  constexpr std::size_t kCrossEdges = 3;
  if (leaves.size() > kRecord) prefetch(&index_->leaves[leaves[kRecord]]);
  if (leaves.size() > kContents) {
    const Leaf& leaf = index_->leaves[leaves[kContents]];
    fetch_positions(*index_, leaf.first, leaf.size);
    fetch_lines(&index_->adjacency[leaf.first], 2);
    fetch_lines(&index_->links[leaf.first_link], 2);
  }
  if (leaves.size() > kCrossEdges) {
    const Leaf& leaf = index_->leaves[leaves[kCrossEdges]];
    fetch_lines(&index_->cross_edges[index_->links[leaf.first_link].first_cross_edge], 2);
    fetch_lines(&index_->leaf_begin[index_->links[leaf.first_link].leaf], 1);
  }
}

bool BallSearch::is_whole(LeafId leaf, const TreeBall& ball) const {
  const Leaf& record = index_->leaves[leaf];
  // mutant: disconnected-leaf-is-whole
  return record.connected && meshhood::classify(record.bounds, ball) == Containment::Inside;
}

void BallSearch::append_intersecting(const LeafBall& ball, std::vector<LeafSubset>& subsets) const {
  constexpr std::size_t kAhead = 4;
  const std::span<const std::uint32_t> leaves = descent_.intersecting_leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kAhead < leaves.size()) fetch_positions(*index_, index_->leaf_begin[leaves[i + kAhead]], kLeafCapacity);
    const VertexId first = index_->leaf_begin[leaves[i]];
    const LaneMask lanes = kernels_->within(index_->positions, first, index_->leaf_begin[leaves[i] + 1] - first, ball);
    if (lanes != 0) subsets.push_back({leaves[i], lanes});
  }
}

}  // namespace meshhood
