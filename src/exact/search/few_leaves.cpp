// SPDX-License-Identifier: MIT
#include "exact/search/few_leaves.h"

#include <algorithm>
#include <bit>
#include <variant>

#include "base/distance.h"

namespace meshhood {
namespace {

constexpr std::size_t kLinksAtOnce = 8;

/// Which of the links leave from one of `lanes`, as bits. There are `count`, at most `kLinksAtOnce`, and one more to
/// read. Without branches, which could not be predicted.
std::uint32_t links_from(const Link* links, std::size_t count, LaneMask lanes) {
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < kLinksAtOnce; ++i) {
    const bool leaves = (links[std::min(i, count)].boundary & lanes) != 0;
    result |= static_cast<std::uint32_t>(leaves) << i;
  }
  return result & first_lanes(static_cast<unsigned>(count));
}

}  // namespace

bool FewLeaves::is_isolated(std::uint32_t slot, const Point& center, double squared_radius) const {
  const LeafId home = leaf_of(slot);
  const std::size_t first = index_->leaf_begin[home];
  return std::visit(
      [&](auto xyz) {
        const auto is_inside = [&](std::size_t vertex) {
          return squared_distance(point(xyz, vertex), center) <= squared_radius;  // mutant: isolated-without-boundary
        };
        bool is_only = true;
        for_each_lane(index_->adjacency[first + lane_of(slot)], [&](unsigned lane) {
          is_only &= !is_inside(first + lane);  // mutant: last-neighbor-counts
        });
        for (const Link& link : index_->links_of(home)) {
          if (!is_only) return false;
          if ((link.boundary >> lane_of(slot) & 1) == 0) continue;
          for (const CrossEdge& edge : index_->cross_edges_of(link)) {
            if (edge.from != lane_of(slot)) continue;
            is_only &= !is_inside(std::size_t{index_->leaf_begin[link.leaf]} + edge.to);  // mutant: isolated-in-leaf
          }
        }
        return is_only;
      },
      index_->positions);
}

bool FewLeaves::find(std::uint32_t slot, const LeafBall& ball, VertexSet& answer) {
  table_.fill(0);
  count_ = 0;
  met_[number_of(leaf_of(slot), ball)].pending = LaneMask{1} << lane_of(slot);
  waiting_ = 1;
  while (waiting_ != 0) {
    Met& met = met_[static_cast<std::size_t>(std::countr_zero(waiting_))];
    waiting_ &= waiting_ - 1;
    const LaneMask added = grow(met);
    if (!expand(met.leaf, added, ball)) return false;
  }
  const std::span<Met> met = std::span(met_).first(count_);
  std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.leaf < b.leaf; });
  for (const Met& one : met) {
    if (one.reached != 0) answer.add_lanes({one.leaf, one.reached});
  }
  return true;
}

/// Reaches what is pending in the leaf and what is connected with it there. Returns the vertices added.
LaneMask FewLeaves::grow(Met& met) {
  const LaneMask* rows = &index_->adjacency[index_->leaves[met.leaf].first];
  const LaneMask added = kernels_->reachable(rows, met.open, met.pending);
  met.open &= ~added;
  met.reached |= added;
  met.pending = 0;
  return added;
}

/// Makes the vertices pending that edges from the vertices `added` of the leaf lead to. Returns false if those are in
/// too many leaves.
bool FewLeaves::expand(LeafId leaf, LaneMask added, const LeafBall& ball) {
  const std::span<const Link> links = index_->links_of(leaf);
  for (std::size_t first = 0; first < links.size(); first += kLinksAtOnce) {  // mutant: links-beyond-eight-ignored
    std::uint32_t which = links_from(links.data() + first, std::min(links.size() - first, kLinksAtOnce), added);
    for (; which != 0; which &= which - 1) {
      const Link& link = links[first + static_cast<std::size_t>(std::countr_zero(which))];
      const unsigned number = number_of(link.leaf, ball);
      if (number == kMostLeaves) return false;
      Met& other = met_[number];
      if (other.open == 0) continue;
      other.pending |= kernels_->cross_edges(index_->cross_edges_of(link), added) & other.open;
      waiting_ |= static_cast<std::uint32_t>(other.pending != 0) << number;  // mutant: answer-ends-at-the-leaf
    }
  }
  return true;
}

/// The number of a leaf, which is met now if it was not before; `kMostLeaves` if there are too many.
unsigned FewLeaves::number_of(LeafId leaf, const LeafBall& ball) {
  std::size_t hash = leaf % kTableSize;
  for (; table_[hash] != 0; hash = (hash + 1) % kTableSize) {
    const unsigned number = table_[hash] - 1U;
    if (met_[number].leaf == leaf) return number;  // mutant: leaf-taken-for-another
  }
  if (count_ == kMostLeaves) return kMostLeaves;
  const Leaf& record = index_->leaves[leaf];
  met_[count_] = {leaf, kernels_->within(index_->positions, record.first, record.size, ball), 0, 0};
  table_[hash] = static_cast<std::uint8_t>(count_ + 1);
  return count_++;
}

}  // namespace meshhood
