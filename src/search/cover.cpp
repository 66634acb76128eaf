// SPDX-License-Identifier: MIT
#include "search/cover.h"

#include "prefetch.h"
#include "search/local_minimum.h"

namespace meshhood {
namespace {

// Below so many mean radii of a leaf, hardly a leaf lies inside and a flood looks at no more of them.
constexpr double kSmallestBall = 2.2;

}  // namespace

bool Cover::run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, Answer& answer) {
  if (static_cast<double>(tree_ball.inner) < kSmallestBall * index_->tree[0].mean_radius) return false;
  if (!descent_.run(tree_ball, answer.runs) || !has_no_minimum(place, ball)) {
    answer.clear();
    return false;
  }
  std::visit([&](const auto& positions) { append_straddling(positions.data(), ball, answer.parts); },
             index_->positions);
  return true;
}

bool Cover::has_no_minimum(std::uint32_t place, const LeafBall& ball) const {
  for (const LeafId leaf : descent_.doubtful_leaves()) {
    if (has_local_minimum(*index_, *kernels_, leaf, place, ball)) return false;
  }
  return true;
}

template <class Real>
void Cover::append_straddling(const Real* positions, const LeafBall& ball, std::vector<PartialLeaf>& parts) const {
  constexpr std::size_t kAhead = 4;
  constexpr std::size_t kPerLine = 64 / sizeof(Real);
  const std::span<const std::uint32_t> leaves = descent_.straddling_leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kAhead < leaves.size()) {
      const Real* next = positions + 3 * std::size_t{index_->leaf_begin[leaves[i + kAhead]]};
      for (std::size_t k = 0; k < std::size_t{3} * kLeafCapacity; k += kPerLine) prefetch(next + k);
    }
    const std::size_t first = index_->leaf_begin[leaves[i]];
    const std::size_t size = index_->leaf_begin[leaves[i] + 1] - first;
    const Lanes lanes = kernels_->within(positions + 3 * first, size, ball);
    if (lanes != 0) parts.push_back({leaves[i], lanes});
  }
}

}  // namespace meshhood
