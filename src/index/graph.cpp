// SPDX-License-Identifier: MIT
// The mesh's graph, taken back out of the leaves and the links between them.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "adjacency.h"
#include "index/index_access.h"

namespace meshhood {
namespace {

/// The positions in the caller's order.
PositionsData positions_of(const IndexStorage& index) {
  return std::visit(
      [&]<class Real>(std::span<const Real> xyz) -> PositionsData {
        std::vector<Real> result(3 * index.vertex_count());
        for (std::size_t i = 0; i < index.vertex_count(); ++i) {
          std::copy_n(&xyz[3 * i], 3, &result[3 * std::size_t{index.id(i)}]);
        }
        return result;
      },
      index.positions);
}

/// Calls `f(v, w)` for every edge in both directions, by the caller's ids.
template <class F>
void for_each_neighbor(const IndexStorage& index, F&& f) {
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    const std::size_t begin = index.leaf_begin[leaf];
    for (std::size_t i = begin; i < index.leaf_begin[leaf + 1]; ++i) {
      for (Lanes left = index.adjacency[i]; left != 0; left &= left - 1) {
        f(index.id(i), index.id(begin + static_cast<std::size_t>(std::countr_zero(left))));
      }
    }
    for (std::size_t i = index.leaves[leaf].first_link; i < index.leaves[leaf + 1].first_link; ++i) {
      const std::size_t other = index.leaf_begin[index.links[i].leaf];
      for (std::size_t k = index.links[i].first_crossing; k < index.links[i + 1].first_crossing; ++k) {
        f(index.id(begin + index.crossings[k].mine), index.id(other + index.crossings[k].other));
      }
    }
  }
}

Adjacency adjacency_of(const IndexStorage& index) {
  Adjacency result = gather_rows(index.vertex_count(), [&](auto&& f) { for_each_neighbor(index, f); });
  for (std::size_t v = 0; v < index.vertex_count(); ++v) {
    std::sort(result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v]),
              result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v + 1]));
  }
  return result;
}

}  // namespace

GraphData graph(const Index& index) {
  const IndexStorage& storage = IndexAccess::storage(index);
  return {positions_of(storage), adjacency_of(storage)};
}

}  // namespace meshhood
