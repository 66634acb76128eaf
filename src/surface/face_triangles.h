// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/surface.h"

#include "base/lists.h"
#include "base/triangulate.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

class TaskContext;

/// A point of a triangle, and its distance from another point.
struct TrianglePoint {
  std::array<double, 3> barycentric;
  Point point;
  double distance;
};

/// Orders points, so that all triangles that have a side take its ends in the same order.
[[nodiscard]] inline bool is_before(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Returns the share of the way from `a` to `b` to the point nearest to the origin; exactly 0 or 1 at the ends.
[[nodiscard]] double share_of_side(const Point& a, const Point& b);

/// Returns the number of the longest of three sides.
[[nodiscard]] std::size_t longest(const std::array<Point, 3>& sides);

/// Returns the point of the triangle nearest to `q`. `scale`, a power of two, makes lengths of the mesh about 1, so
/// that products do not overflow. For a corner, the distance is that of the predicate. Triangles that share a side or a
/// corner have the same distance there, bit for bit, whatever the order of their corners.
[[nodiscard]] TrianglePoint nearest_in_triangle(const Point& q, const std::array<Point, 3>& corners, double scale);

/// Bounds of the distance between a point and a triangle that are found quickly.
struct RoughDistance {
  double square;  // of the distance of some point of the triangle, mostly the nearest
  double least;   // of the squares of all distances; may be not a number
};

/// No point of a triangle is nearer than its corners are along any direction; that to its nearest point tells the most.
[[nodiscard]] RoughDistance compare_roughly(const std::array<Point, 3>& corners, const Point& q);

/// Boxes farther than this from a point have no triangle nearer than `distance`; both are in the frame. The distance of
/// a triangle is off by a few units in the last place of itself and of the sides, which are at most 4 there, and
/// squares of distances may underflow.
[[nodiscard]] inline double reach_of(double distance, double scale) {
  constexpr double kSlack = 0x1p-43;
  constexpr double kUnderflow = 0x1p-535;
  return distance + kSlack * (distance + 4) + kUnderflow * scale;
}

/// A triangle of the triangulation of a face (see base/triangulate.h).
struct Triangle {
  std::array<std::uint32_t, 3> corners;  // places in index order
  std::uint32_t face;
  std::uint32_t diagonals;  // a bit for each of its sides that lies inside the face
};

/// A triangle, and what a search found of it; by default none.
struct TriangleHit {
  std::size_t triangle = 0;
  TrianglePoint at{{}, {}, kInfinity};
};

/// Returns whether `a` is nearer than `b`, or at the same distance of a face with a smaller number.
[[nodiscard]] inline bool precedes(const TriangleHit& a, const TriangleHit& b, std::span<const Triangle> triangles) {
  const auto rank = [&](const TriangleHit& hit) {
    return std::tuple(hit.at.distance, triangles[hit.triangle].face, hit.triangle);
  };
  return rank(a) < rank(b);
}

/// Returns the number of triangles of a face that has `corners` corners.
[[nodiscard]] constexpr std::size_t triangle_count(std::size_t corners) { return corners < 3 ? 0 : corners - 2; }

/// Divides faces of an index into triangles.
class Triangulator {
 public:
  explicit Triangulator(const IndexView& index) : index_(&index) {}

  /// Writes `triangle_count(corners.size())` triangles.
  void run(std::uint32_t face, std::span<const VertexId> corners, Triangle* out);

 private:
  const IndexView* index_;
  std::vector<Point> points_;
  Triangulation triangles_;
};

/// Throws Error{InvalidOption}, with `where`, then the face.
[[noreturn]] void raise_no_such_face(std::size_t face, std::size_t faces, const std::string& where = {});

/// Throws Error{InvalidMesh} if no face has a triangle.
inline void check_triangle_count(std::size_t triangles) {
  if (triangles == 0) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
}

/// Returns by leaf the triangles of the faces without a wall whose first corner in index order is there, in the order
/// of these corners, then of the faces. Throws Error{InvalidMesh} if no face, with or without a wall, has a triangle,
/// and Error{Cancelled}.
[[nodiscard]] Lists<Triangle, std::size_t> triangles_of_leaves(const IndexView& index, const StoredFaces& faces,
                                                               TaskContext& task);

/// Returns the positions of the corners of a triangle.
[[nodiscard]] std::array<Point, 3> corners_of(const IndexView& index, const std::array<std::uint32_t, 3>& places);

/// Returns these positions in the frame.
[[nodiscard]] inline std::array<Point, 3> corners_in_frame(const IndexView& index,
                                                           const std::array<std::uint32_t, 3>& places) {
  return {index.in_frame(places[0]), index.in_frame(places[1]), index.in_frame(places[2])};
}

/// Returns a point of a triangle of a face, with these corners, as callers see it.
[[nodiscard]] SurfacePoint surface_point(const IndexView& index, const StoredFaces& faces, std::size_t face,
                                         const std::array<std::uint32_t, 3>& places, const TrianglePoint& found);

}  // namespace meshhood::inline v0_1
