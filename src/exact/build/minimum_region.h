// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "meshhood/mesh.h"

#include "base/distance.h"

namespace meshhood {

/// Where a query vertex may stand so that some vertex of a leaf is a local minimum of the distance to it: none of its
/// neighbours is nearer. On a nearly flat leaf that is a region over the leaf along its normal, above and below. Seen
/// from outside the region, every vertex of the leaf has a nearer neighbour.
///
/// A point `x` from the centre of the leaf's bounding sphere lies in the region where `|x| <= reach + |x . axis|`.
struct MinimumRegion {
  Point axis{0, 0, 0};  // longer than 1: the more so, the wider the region opens
  double reach;         // infinite where no region is known
};

/// Around everything.
inline constexpr MinimumRegion kUnboundedRegion{{0, 0, 0}, std::numeric_limits<double>::infinity()};

/// An edge of a leaf's vertex, to any vertex of the mesh.
struct LeafEdge {
  std::uint32_t lane;
  std::uint32_t neighbor;  // in index order
};

/// The region of the vertices `first .. first + size - 1` of `points`, which are all vertices of the mesh in index
/// order, in the frame. `edges`: theirs, in any order.
[[nodiscard]] MinimumRegion leaf_minimum_region(std::span<const Point> points, std::size_t first, std::size_t size,
                                                std::span<const LeafEdge> edges, const Point& centre);

/// A region around the regions of `children`, which stand at `centres`, seen from `centre`.
[[nodiscard]] MinimumRegion enclosing_minimum_region(std::span<const MinimumRegion> children,
                                                     std::span<const Point> centres, const Point& centre);

}  // namespace meshhood
