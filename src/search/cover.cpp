// SPDX-License-Identifier: MIT
#include "search/cover.h"

#include <algorithm>

#include "prefetch.h"
#include "search/local_minimum.h"

namespace meshhood {
namespace {

// Below so many mean radii of a leaf, hardly a leaf lies inside and a flood looks at no more of them.
constexpr double kSmallestBall = 2.0;

bool are_linked(const IndexStorage& index, LeafId a, LeafId b) {
  const auto first = index.links.begin() + index.leaves[a].first_link;
  const auto last = index.links.begin() + index.leaves[a + 1].first_link;
  return std::any_of(first, last, [b](const Link& link) { return link.leaf == b; });
}

}  // namespace

bool Cover::run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, Answer& answer) {
  const auto radius = static_cast<double>(tree_ball.inner);
  const LeafId home = place / kLeafCapacity;
  if (radius < kSmallestBall * index_->tree[0].mean_radius || !memory_.is_worth_trying(home, radius)) return false;
  const bool proved = prove(place, ball, tree_ball, answer.runs);
  memory_.tell(home, radius, proved);
  if (!proved) {
    answer.clear();
    return false;
  }
  std::visit([&](const auto& positions) { append_straddling(positions.data(), ball, answer.parts); },
             index_->positions);
  return true;
}

/// Appends the runs that lie inside; false if something else may lie there.
bool Cover::prove(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball,
                  std::vector<VertexRange>& runs) {
  return descent_.run(tree_ball, runs) && has_no_minimum(place, ball, tree_ball);
}

bool Cover::has_no_minimum(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball) const {
  const LeafId home = place / kLeafCapacity;
  const auto is_whole = [&](LeafId leaf) {
    const Leaf& record = index_->leaves[leaf];
    return record.connected && meshhood::place(record.bounds, tree_ball) == Placement::Inside;
  };
  const bool home_is_whole = is_whole(home);
  for (const LeafId leaf : descent_.doubtful_leaves()) {
    // The leaves around the query vertex always look doubtful, but mostly hang together with it as they are.
    if (home_is_whole && (leaf == home || (are_linked(*index_, home, leaf) && is_whole(leaf)))) continue;
    if (has_local_minimum(*index_, *kernels_, leaf, place, ball)) return false;
  }
  return true;
}

template <class Real>
void Cover::append_straddling(const Real* positions, const LeafBall& ball, std::vector<PartialLeaf>& parts) const {
  constexpr std::size_t kAhead = 4;
  constexpr std::size_t kLines = 3 * kLeafCapacity * sizeof(Real) / kCacheLine;
  const std::span<const std::uint32_t> leaves = descent_.straddling_leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kAhead < leaves.size()) {
      fetch_lines(positions + 3 * std::size_t{index_->leaf_begin[leaves[i + kAhead]]}, kLines);
    }
    const std::size_t first = index_->leaf_begin[leaves[i]];
    const std::size_t size = index_->leaf_begin[leaves[i] + 1] - first;
    const Lanes lanes = kernels_->within(positions + 3 * first, size, ball);
    if (lanes != 0) parts.push_back({leaves[i], lanes});
  }
}

}  // namespace meshhood
