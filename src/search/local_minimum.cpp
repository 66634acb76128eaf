// SPDX-License-Identifier: MIT
#include "search/local_minimum.h"

#include <algorithm>
#include <array>
#include <bit>

namespace meshhood {
namespace {

using Squares = std::array<double, kLeafCapacity>;

template <class Real>
void squared_distances(const Real* xyz, std::size_t size, const Point& centre, Squares& out) {
  for (std::size_t i = 0; i < size; ++i) {
    out[i] = squared_distance(point(std::span(xyz, 3 * size), i), centre);
  }
}

/// Those of `lanes` that have no nearer neighbour in the leaf.
Lanes minima_within(const Lanes* adjacency, Lanes lanes, const Squares& squares) {
  Lanes result = 0;
  for (Lanes left = lanes; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    bool lowest = true;
    for (Lanes near = adjacency[lane]; near != 0 && lowest; near &= near - 1) {
      lowest = squares[static_cast<std::size_t>(std::countr_zero(near))] >= squares[lane];
    }
    result |= Lanes{lowest} << lane;
  }
  return result;
}

bool has_nearer_neighbor_outside(const IndexStorage& index, LeafId leaf, unsigned lane, double square,
                                 const Point& centre) {
  for (std::uint32_t i = index.leaves[leaf].first_link; i < index.leaves[leaf + 1].first_link; ++i) {
    const Link& link = index.links[i];
    if ((link.border >> lane & 1U) == 0) continue;
    for (std::uint32_t k = link.first_crossing; k < index.links[i + 1].first_crossing; ++k) {
      const Crossing& crossing = index.crossings[k];
      if (crossing.mine != lane) continue;
      if (squared_distance(index.position(link.leaf, crossing.other), centre) < square) return true;
    }
  }
  return false;
}

}  // namespace

bool has_local_minimum(const IndexStorage& index, const Kernels& kernels, LeafId leaf, std::uint32_t place,
                       const LeafBall& ball) {
  const Leaf& record = index.leaves[leaf];
  Squares squares;
  const Lanes inside = std::visit(
      [&](const auto& positions) {
        const auto* xyz = positions.data() + 3 * std::size_t{record.first};
        squared_distances(xyz, record.size, ball.centre, squares);
        return kernels.within(xyz, record.size, ball);
      },
      index.positions);
  const bool whole = record.connected && inside == first_lanes(record.size);
  const bool holds_centre = place / kLeafCapacity == leaf;
  Lanes candidates = 0;
  if (whole) {
    // One component holds the whole leaf; if it does not hold the centre, its nearest vertex here stands for all.
    if (holds_centre) return false;
    const auto nearest = std::min_element(squares.begin(), squares.begin() + record.size) - squares.begin();
    candidates = Lanes{1} << nearest;
  } else {
    candidates = minima_within(&index.adjacency[record.first], inside, squares);
    if (holds_centre) candidates &= ~(Lanes{1} << place % kLeafCapacity);
  }
  for (; candidates != 0; candidates &= candidates - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(candidates));
    if (!has_nearer_neighbor_outside(index, leaf, lane, squares[lane], ball.centre)) return true;
  }
  return false;
}

}  // namespace meshhood
