// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "meshhood/mesh.h"

#include "base/distance.h"

namespace meshhood {

/// The points from which some vertex of a set may be a local minimum of the distance, which means that none of its
/// neighbors is nearer. Seen from any point outside the region, every vertex of the set has a nearer neighbor. For a
/// nearly flat set the region extends along the normal to both sides, like a double cone with a rounded waist.
///
/// The point `x`, relative to the center of the set's bounding sphere, lies in the region if
/// `|x| <= offset + |x . slope_axis|`.
struct MinimumRegion {
  Point slope_axis{0, 0, 0};  // its length is at least 1, and grows with the opening angle
  double offset;              // infinite if no smaller region is known than all of space
};

inline constexpr MinimumRegion kUnboundedRegion{{0, 0, 0}, std::numeric_limits<double>::infinity()};

/// An edge from a vertex of a leaf.
struct LeafEdge {
  std::uint32_t lane;
  std::uint32_t neighbor;  // in `points` below; or another lane
};

/// A region of the vertices `first .. first + size - 1`, 1 to 32 of them.
///
/// points     at least these vertices and their neighbors, in the frame
/// own_edges  the edges between two of these vertices, by their lanes, each once
/// edges      their other edges, by lane and place in `points`. All edges may be given in this way, in both directions
/// center     the center of the leaf's bounding sphere
/// O(edges log(valence)).
[[nodiscard]] MinimumRegion leaf_minimum_region(std::span<const Point> points, std::size_t first, std::size_t size,
                                                std::span<const LeafEdge> own_edges, std::span<const LeafEdge> edges,
                                                const Point& center);

/// A region, relative to `center`, that contains the regions of `children`, which are relative to `centers`.
[[nodiscard]] MinimumRegion enclosing_minimum_region(std::span<const MinimumRegion> children,
                                                     std::span<const Point> centers, const Point& center);

}  // namespace meshhood
