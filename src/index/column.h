// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
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

/// An edge of a leaf's vertex, to any vertex of the mesh.
struct LeafEdge {
  std::uint32_t lane;
  std::uint32_t neighbor;  // in index order
};

/// The column of the vertices `first .. first + size - 1` of `points`, which are all vertices of the mesh in index
/// order, in the frame. `edges`: theirs, in any order.
[[nodiscard]] Column leaf_column(std::span<const Point> points, std::size_t first, std::size_t size,
                                 std::span<const LeafEdge> edges, const Point& centre);

/// A column around the columns of `children`, which stand at `centres`, seen from `centre`.
[[nodiscard]] Column enclosing_column(std::span<const Column> children, std::span<const Point> centres,
                                      const Point& centre);

}  // namespace meshhood
