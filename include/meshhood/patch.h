// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/run.h"
#include "meshhood/start.h"
#include "meshhood/surface.h"
#include "meshhood/vertex.h"

/// The surface in a ball, rather than its vertices: areas, volumes and gaps that do not depend on the triangles.
///
/// The **patch** of a point of the surface and a radius is the component, with the point, of the surface inside the
/// closed ball. The part of a triangle in a ball is convex, so the patch is a set of faces: those with a point in the
/// ball, joined where a corner or a side that they share has a point in the ball. It has the neighborhood of a vertex,
/// and does not change if faces are divided. A side that misses the ball by up to 2^-46 radii touches it.
///
///     const meshhood::Surface surface(index, faces);
///     const auto [area, volume] = meshhood::invariants(surface, {.radius = 1.5});
///     const std::vector<meshhood::SurfacePoint> gaps = meshhood::gaps(surface, {.radius = 1.5});
///     const meshhood::ClippedMesh disc = meshhood::PatchSearcher(surface).clip(42, 1.5);
///
/// Faces are oriented counterclockwise, seen from outside. Polygons are the triangles of `Surface`; diagonals join them
/// as sides do. A face with a wall (see masks.h), or with fewer than three corners, is not there. Vertices at the same
/// place are not one: weld a mesh that has such.
///
/// A surface makes what all searches share at the first of them, and again after a refit: about 37 bytes a triangle, in
/// O(#V + #corners log #corners). It throws Error{InvalidMesh} if the mesh has no face of three corners.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The start of a patch: a vertex, or a point on a face.
class PatchStart {
 public:
  template <std::convertible_to<Vertex> V>
  PatchStart(const V& v) : vertex_(Vertex(v)) {}

  /// point  on the face, up to rounding (see `Surface::closest_point` and `point_on_face`). There is no patch if the
  ///        face is farther from it than the radius.
  PatchStart(std::size_t face, const SpacePoint& point) : face_(face), point_(point) {}

  /// Returns the vertex, unless there is a face.
  [[nodiscard]] VertexId vertex() const { return vertex_; }
  [[nodiscard]] const std::optional<std::size_t>& face() const& { return face_; }
  [[nodiscard]] const std::optional<std::size_t>& face() const&& = delete;
  [[nodiscard]] const SpacePoint& point() const& { return point_; }
  [[nodiscard]] const SpacePoint& point() const&& = delete;

 private:
  VertexId vertex_ = 0;
  std::optional<std::size_t> face_;
  SpacePoint point_{};
};

/// The area of a patch, and the volume of the part of its ball behind it.
struct PatchMeasure {
  double area;
  double volume;
};

/// A patch as a mesh of its own, of triangles. Its points are vertices, points where sides enter the ball, and points
/// that divide the arcs along which faces leave it. Sides that faces share are cut at the same points, so the border of
/// this mesh is where the patch leaves the ball, and the border of the surface.
struct ClippedMesh {
  std::vector<SpacePoint> points;
  std::vector<std::array<VertexId, 3>> vertices;  ///< of each point, by their ids in the whole mesh: see `clip`
  std::vector<std::array<double, 3>> weights;     ///< barycentric coordinates in these: >= 0, with the sum 1
  std::vector<std::size_t> faces;  ///< of each triangle: the number of the face it is a part of; ascending
  std::vector<std::array<VertexId, 3>> triangles;  ///< as numbers of `points`
  double area = 0;  ///< of the patch, as `PatchSearcher::measure` says; that of the triangles is a little less

  /// Borrows from this object. A view of a temporary does not compile.
  [[nodiscard]] MeshView view() const& { return {points, FacesView::triangles(triangles)}; }
  [[nodiscard]] MeshView view() const&& = delete;
};

/// Answers one start at a time; use one object per thread. It owns 2 bytes a vertex and 2 a triangle, and shares the
/// memory of the surface, which may be moved or destroyed. After a refit, make a new one. One that has been moved from
/// can be assigned and destroyed.
///
/// radius  >= 0 or infinite. A point at exactly `radius` counts.
/// All calls throw Error{VertexOutOfRange, InvalidRadius, InvalidOption}: InvalidOption for a face or point that is not
/// of the mesh, and after a refit in place. They take O(k) for k triangles near the surface of the ball, and meshlets
/// inside.
class PatchSearcher {
 public:
  explicit PatchSearcher(const Surface& surface);

  /// Returns the numbers of the faces, ascending; none where there is no patch, as at a vertex without faces.
  [[nodiscard]] std::vector<std::size_t> patch(const PatchStart& start, double radius);

  /// Returns the patch as a mesh. Vertices of the ball are points of it; all others have the distance `radius` from the
  /// start, up to the rounding of their coordinates. Chords replace the arcs along which faces leave the ball. A side
  /// touches the sphere in one point where what it has in the ball is within 2^-46 radii of the sphere.
  ///
  /// Points come in this order, and those of a kind by their `vertices`:
  /// - vertices, three times the same;
  /// - (b, a, a), where the way from b to a enters the ball. Then b is outside, and a may be, too;
  /// - the corners of a triangle, of a point on an arc, in the order of the faces.
  ///
  /// tolerance  in [1e-12, 1]: no chord is farther from its arc than `tolerance` times `radius`. So the area of the
  ///            triangles is less than `area` by at most that times the length of all arcs.
  /// Takes O(k log k) for k triangles and points. Throws also Error{InvalidOption} for the tolerance.
  [[nodiscard]] ClippedMesh clip(const PatchStart& start, double radius, double tolerance = 1e-3);

  /// Returns area and volume, each accurate to 1e-12 of pi r^2 and of the volume of the ball. They do not depend on how
  /// the surface is divided into triangles.
  ///
  /// The volume is that of the part of the ball behind the patch, which other patches in the ball do not change. It is
  /// NaN where there is no patch, whose area is 0, and where the patch has a border of the mesh, a side at which the
  /// orientation changes, or a side of a face that is listed twice. No volume is negative. A sheet of two sides that is
  /// thinner than 2^-41 of the radius, or of the mesh if that is smaller, has nothing behind it; if it has only
  /// needles, rounding decides. Where a surface intersects itself, what it encloses twice counts twice, what is inside
  /// out counts negative, and multiples of the volume of the ball are added or taken, so that none is larger.
  [[nodiscard]] PatchMeasure measure(const PatchStart& start, double radius);

  /// Returns the nearest point of the surface in the ball that is not of the patch; of several faces at the same
  /// distance, the one with the smallest number; none (see `SurfacePoint`) where there is no such point, or no patch.
  /// Accurate as `Surface::closest_point`.
  [[nodiscard]] SurfacePoint gap(const PatchStart& start, double radius);

 private:
  struct State;
  detail::Owner<State> state_;
};

/// One value for each row; #radii by #rows if the query has scales.
struct Invariants {
  std::vector<double> area;
  std::vector<double> volume;
};

/// Measures the patches of many vertices as `PatchSearcher::measure`, but for rounding: the integral invariants of a
/// surface (Manay et al. 2004; Pottmann, Wallner, Huang, Yang, "Integral invariants for robust geometry processing",
/// 2009). On a sphere with outward normals, (2 pi / 3 r^3 - volume) 4 / (pi r^4) is its mean curvature.
///
/// query  as of a batch. Error{InvalidOption} unless its metric is `Straight`.
/// The patches of a leaf are found together, from the neighborhoods of its vertices. Where a neighborhood is joined by
/// an edge that is no side of a face without walls, each is searched alone. A row depends on surface, vertex and radius
/// alone, bit for bit. Each thread owns 5 bytes a vertex and, if it searches alone, 2 more and 2 a triangle. Throws
/// Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
[[nodiscard]] Invariants invariants(const Surface& surface, const BatchQuery& query, const Run& run = {});

/// Measures the patches of many points of faces as `PatchSearcher::measure`, bit for bit: each alone, in O(k).
///
/// faces, points  #rows: the numbers of the faces, and a point of each (see `PatchStart`).
/// radius         one, one for each row, or scales.
/// Throws Error{InvalidRadius, InvalidOption, Cancelled}, naming the row; InvalidOption also if the numbers of rows
/// differ, and after a refit in place. Needs at most 72 bytes a row, the result, and a `PatchSearcher` per thread.
[[nodiscard]] Invariants invariants(const Surface& surface, const IndicesView& faces,
                                    std::span<const SpacePoint> points, const BatchRadius& radius, const Run& run = {});

/// Returns `PatchSearcher::gap` of many vertices, #rows, or #radii by #rows with scales. Throws as `invariants`.
[[nodiscard]] std::vector<SurfacePoint> gaps(const Surface& surface, const BatchQuery& query, const Run& run = {});

/// Returns `PatchSearcher::gap` of many points of faces. Arguments, cost and errors are those of `invariants`.
[[nodiscard]] std::vector<SurfacePoint> gaps(const Surface& surface, const IndicesView& faces,
                                             std::span<const SpacePoint> points, const BatchRadius& radius,
                                             const Run& run = {});

/// Calls `visit(row, gap)` once for each row instead, in any order and on the threads of the call, several at a time:
/// for a caller that keeps only a part of each gap. An exception of `visit` ends the call, and is passed on.
void for_each_gap(const Surface& surface, const BatchQuery& query, const SurfacePointVisitor& visit,
                  const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
