// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>

#include "meshhood/mesh.h"

#include "distance.h"

namespace meshhood {

/// Where a query vertex may stand so that some vertex of a leaf is a local minimum of the distance to it: none of its
/// neighbours is nearer. On a nearly flat leaf that is a column over the leaf along its normal, above and below. Seen
/// from outside the column, every vertex of the leaf has a nearer neighbour.
///
/// A point `x` from the centre of the leaf's bounding sphere lies in the column where `|x| <= reach + |x . axis|`.
struct Column {
  Point axis{0, 0, 0};  // longer than 1: the more so, the wider the column opens
  double reach;         // infinite where no column is known
};

/// Around everything.
inline constexpr Column kNoColumn{{0, 0, 0}, std::numeric_limits<double>::infinity()};

/// The column of some vertices. `points` are all positions in the frame; `adjacency` of vertex `i` is
/// `neighbors[offsets[i]] ..`.
struct ColumnInput {
  std::span<const Point> points;  // of the whole mesh
  std::size_t begin;              // the vertices of the leaf
  std::size_t end;
  std::span<const std::uint32_t> neighbors;  // of them, one after another, by their number in `points`
  std::span<const std::uint32_t> degrees;    // by vertex of the leaf
};
[[nodiscard]] Column leaf_column(const ColumnInput& leaf, const Point& centre);

/// A column around the columns of `children`, which stand at `centres`, seen from `centre`.
[[nodiscard]] Column enclosing_column(std::span<const Column> children, std::span<const Point> centres,
                                      const Point& centre);

}  // namespace meshhood
