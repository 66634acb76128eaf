// SPDX-License-Identifier: MIT
// The region of one vertex u. Let e be the edge from u to a neighbor w, and let the query point be u + x. Then w is
// nearer than u if x . e > e . e / 2. Split x into its height h along the leaf's normal and a vector p in the plane
// across it, and e likewise into k and d: w is nearer if
//     p . d > e . e / 2 - h k.
// The p from which no neighbor is nearer form a polygon of half planes, one for each neighbor; at h = 0 it is about
// the Voronoi cell of u among its neighbors. HalfplanePolygon gives `width` and `slope` with |p| <= width + slope |h|.
//
// The region of a leaf. Let o be the vector from the leaf's center to u, with height m and part q in the plane, and let
// X = o + x be the query point seen from the center, with height H and part P in the plane. Then
//     |P| <= |q| + |p| <= |q| + width + slope (|H| + |m|).
// The maxima over all vertices of |q| + width + slope |m| and of slope hold for the leaf; call them W and S. As (|P|,
// |H|) is componentwise at most (W, 0) + |H| (S, 1),
//     |X| <= W + sqrt(1 + S^2) |H|.
// This is the inequality of MinimumRegion, with offset = W and slope_axis = sqrt(1 + S^2) times the normal.
#include "exact/build/minimum_region.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/limits.h"
#include "base/vector.h"
#include "exact/build/halfplane_polygon.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

// A longer slope axis, of a region that opens wide, would use up the margin that the search leaves for rounding
// (kRegionMargin).
constexpr double kLongestSlopeAxis = 4;

// The rows of a symmetric matrix.
using Symmetric = std::array<Point, 3>;

Symmetric covariance(std::span<const Point> points, const Point& center) {
  Symmetric sum{};
  for (const Point& p : points) {
    const Point d = p - center;
    sum[0] = sum[0] + d.x * d;
    sum[1] = sum[1] + d.y * d;
    sum[2] = sum[2] + d.z * d;
  }
  return sum;
}

Point mean(std::span<const Point> points) {
  Point sum{};
  for (const Point& p : points) sum = sum + p;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

/// The direction in which the points spread least, or any direction if there is more than one. The cofactors of the
/// covariance have its eigenvectors in reverse order of eigenvalues, and squaring them repeatedly (power iteration)
/// leaves the dominant one.
Point flattest_direction(std::span<const Point> points) {
  const Symmetric c = covariance(points, mean(points));
  Symmetric power = {cross(c[1], c[2]), cross(c[2], c[0]), cross(c[0], c[1])};
  for (int i = 0; i < 5; ++i) {
    const double trace = power[0].x + power[1].y + power[2].z;
    if (!(trace > 1e-280)) return {0, 0, 1};
    for (Point& row : power) row = 1 / trace * row;
    const Symmetric m = power;
    for (std::size_t k = 0; k < 3; ++k) power[k] = {dot(m[k], m[0]), dot(m[k], m[1]), dot(m[k], m[2])};
  }
  const Point& longest = *std::max_element(power.begin(), power.end(),
                                           [](const Point& a, const Point& b) { return dot(a, a) < dot(b, b); });
  const double norm = length(longest);
  return norm > 0 ? 1 / norm * longest : Point{0, 0, 1};
}

/// An orthonormal basis with the given third vector, which has length 1.
struct Basis {
  Point first;
  Point second;
  Point normal;

  explicit Basis(const Point& direction) : first{}, second{}, normal(direction) {
    const Point other = std::abs(direction.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point across = cross(direction, other);
    first = 1 / length(across) * across;
    second = cross(direction, first);
  }
};

/// The query points from which the end of edge `e` is not nearer than its start.
Halfplane halfplane_of(const Point& e, const Basis& basis) {
  const double x = dot(e, basis.first);
  const double y = dot(e, basis.second);
  const double k = dot(e, basis.normal);
  return {x, y, k, (x * x + y * y + k * k) / 2};  // mutant: bisector-too-near
}

/// That of the same edge from its other end, to the last bit: every rounding is symmetric.
Halfplane opposite(const Halfplane& halfplane) {
  return {-halfplane.x, -halfplane.y, -halfplane.tilt, halfplane.offset};  // mutant: opposite-tilts-the-same-way
}

}  // namespace

MinimumRegion leaf_minimum_region(std::span<const Point> points, std::size_t first, std::size_t size,
                                  std::span<const LeafEdge> own_edges, std::span<const LeafEdge> edges,
                                  const Point& center) {
  const std::span<const Point> own = points.subspan(first, size);
  const Basis basis(flattest_direction(own));
  std::array<HalfplanePolygon, kLeafCapacity> polygons;
  for (const LeafEdge& edge : own_edges) {
    const Halfplane halfplane = halfplane_of(own[edge.neighbor] - own[edge.lane], basis);
    const double edge_length = std::sqrt(2 * halfplane.offset);
    polygons[edge.lane].add(halfplane, edge_length);
    polygons[edge.neighbor].add(opposite(halfplane), edge_length);
  }
  for (const LeafEdge& edge : edges) {
    const Halfplane halfplane = halfplane_of(points[edge.neighbor] - own[edge.lane], basis);
    polygons[edge.lane].add(halfplane, std::sqrt(2 * halfplane.offset));  // mutant: edges-of-next-lane
  }
  double width = 0;
  double slope = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point o = own[i] - center;
    const double x = dot(o, basis.first);
    const double y = dot(o, basis.second);
    // No std::hypot, which every C library rounds in its own way.
    const double distance = std::sqrt(x * x + y * y);
    const double height = std::abs(dot(o, basis.normal));
    const auto offset = [&](const PolygonExtent& extent) {
      // mutant: slope-over-own-height-ignored, distance-from-center-ignored
      return distance + extent.width + extent.slope * height;
    };
    const PolygonExtent rough = polygons[i].rough_extent();
    if (offset(rough) <= width && rough.slope <= slope) continue;
    const PolygonExtent extent = polygons[i].extent(rough);
    width = std::max(width, offset(extent));
    slope = std::max(slope, extent.slope);  // mutant: region-never-opens
  }
  const double stretch = std::sqrt(1 + slope * slope);  // mutant: stretch-of-slope-only
  if (!(stretch <= kLongestSlopeAxis) || !(width < kInfinity)) return kUnboundedRegion;
  return {stretch * basis.normal, width};
}

// Let o be the vector from `center` to the center of a child, x and x' = x - o a point seen from the two, a the child's
// slope axis and b the unit vector of the new one. The child's inequality is |x'| <= offset + |x' . a|. Split a into
// its part along b, of length `cosine` = |a . b|, and the part across, of length |a x b|:
//     |x'| <= offset + cosine |x' . b| + |a x b| |x'|,
// so with `rest` = 1 - |a x b|, if it is positive,
//     |x'| <= (offset + cosine |x' . b|) / rest.
// By |x| <= |o| + |x'| and |x' . b| <= |x . b| + |o . b|,
//     |x| <= |o| + (offset + cosine |o . b|) / rest + (cosine / rest) |x . b|.
// The largest offset and the largest `stretch` = cosine / rest hold for all children.
MinimumRegion enclosing_minimum_region(std::span<const MinimumRegion> children, std::span<const Point> centers,
                                       const Point& center) {
  Point sum{};
  // An axis and its opposite mean the same region: each is turned to the side of those before.
  for (const MinimumRegion& child : children) {
    // mutant: opposite-axes-cancel
    sum = dot(child.slope_axis, sum) < 0 ? sum - child.slope_axis : sum + child.slope_axis;
  }
  const double norm = length(sum);
  if (!(norm > 0)) return kUnboundedRegion;
  const Point axis = 1 / norm * sum;
  double offset = 0;
  double stretch = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const double cosine = std::abs(dot(children[i].slope_axis, axis));
    const double rest = 1 - length(cross(children[i].slope_axis, axis));            // mutant: tilted-axis-costs-nothing
    if (!(rest > 0) || !(children[i].offset < kInfinity)) return kUnboundedRegion;  // mutant: tilted-child-accepted
    const Point o = centers[i] - center;
    // mutant: center-offset-ignored, height-of-center-ignored
    offset = std::max(offset, length(o) + (children[i].offset + cosine * std::abs(dot(o, axis))) / rest);
    stretch = std::max(stretch, cosine / rest);  // mutant: slope-not-stretched
  }
  if (!(stretch <= kLongestSlopeAxis)) return kUnboundedRegion;
  return {stretch * axis, offset};
}

}  // namespace meshhood
