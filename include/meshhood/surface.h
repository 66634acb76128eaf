// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/start.h"
#include "meshhood/vertex_id.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// No face.
inline constexpr std::size_t kNoFace = (std::numeric_limits<std::size_t>::max)();

/// A point on a face; by default none.
struct SurfacePoint {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::size_t face = kNoFace;                                         ///< its number
  std::array<std::size_t, 3> corners{};                               ///< of its triangle: their places in the face
  std::array<VertexId, 3> vertices{kNoVertex, kNoVertex, kNoVertex};  ///< of its triangle
  std::array<double, 3> barycentric{kNone, kNone, kNone};  ///< coordinates in it: >= 0, with the sum 1 up to rounding
  SpacePoint point{kNone, kNone, kNone};
  double distance = std::numeric_limits<double>::infinity();  ///< from the point that was asked for

  /// Returns a search from the corners of the triangle, with the point as center: what a click on a surface gives. It
  /// borrows from this object.
  [[nodiscard]] Start start() const& { return {point, vertices}; }
  [[nodiscard]] Start start() const&& = delete;
};

/// Receives the answer of a row.
using SurfacePointVisitor = std::function<void(std::size_t row, const SurfacePoint& point)>;

/// Which faces belong to a set of vertices: those with all corners in the set, or with at least one.
enum class Corners : std::uint8_t { All, Any };

/// Some faces of a mesh, as a mesh of their own.
struct Submesh {
  std::vector<VertexId> vertices;  ///< its vertices by their ids in the whole mesh, ascending: the corners of its faces
  std::vector<std::size_t> faces;  ///< its faces by their numbers in the whole mesh, ascending
  std::vector<std::uint64_t>
      offsets;                    ///< #faces + 1: face `i` has the corners from `offsets[i]` to `offsets[i + 1] - 1`
  std::vector<VertexId> corners;  ///< as positions in `vertices`; in the order of the whole mesh
};

/// The lines along which a surface leaves a ball.
struct Rim {
  std::vector<SpacePoint> points;              ///< of all polylines, one after the other
  std::vector<std::array<VertexId, 2>> edges;  ///< of each point: the end of its edge inside the region, and the other
  std::vector<std::size_t> offsets;            ///< #polylines + 1: the first point of each polyline
  std::vector<std::uint8_t> closed;            ///< of each polyline, 1: a loop, whose last point is joined to its first

  /// Returns the number of polylines.
  [[nodiscard]] std::size_t size() const { return closed.size(); }
};

/// The faces of a mesh beside its index. They give what a set of vertices does not: the nearest point of the surface,
/// and the faces of a neighborhood, its outline, its area and its shape.
///
///     const meshhood::Surface surface(index, faces);
///     const auto hit = surface.closest_point({0.1, 0.2, 0.3});
///     searcher.neighborhood(hit.start(), 1.5, ids);
///     const auto part = surface.submesh(ids);
///     const auto [k1, k2, d1, d2, state, count] = meshhood::curvatures(surface, {.radius = 2.5});
///     const std::vector<double> across_walls = meshhood::thickness(surface);
///
/// A polygon is the fan of the triangles of its corners 0, i and i + 1 if it is convex; otherwise its ears are cut off,
/// so that its triangles cover what it covers. A face with fewer than three corners has no points, and no area.
///
/// What depends on the faces is made when it is first needed, and kept: 52 bytes a triangle for closest points and
/// rays, and 2.3 more for thickness by balls, 37 bytes a triangle for patches (see patch.h), 24 bytes a vertex for
/// curvature, 4 bytes a corner and 8 a vertex for the faces of each vertex, 8 bytes a vertex for areas. The first call
/// of its kind so takes O(#V + #corners), and O(n log n) for the n triangles of closest points and patches. A polygon
/// of n corners that is not convex may take O(n^3) where ears are rare.
///
/// Any number of threads may use it, but for `refit_in_place`. It shares the memory of the index, as a searcher does:
/// the index may be moved or destroyed. After a refit of the index in place, calls throw Error{InvalidOption} until
/// `refit_in_place` of the surface. A surface that has been moved from can be assigned and destroyed.
class Surface {
 public:
  /// faces  those of the mesh that the index was built from; copied, 4 bytes a corner.
  /// Throws Error{InvalidMesh, TooLarge} if they are invalid (see `validate`). Takes O(#V + #corners).
  Surface(const Index& index, const FacesView& faces);

  /// Does the same; throws also Error{InvalidMesh} if `mesh` has other positions than the index.
  Surface(const Index& index, const MeshView& mesh);

  /// Returns a surface with these normals instead of those of its faces. Without faces, it serves for curvature alone.
  ///
  /// normals  #V by 3, in the order of the caller's vertices, of any length; copied. A vertex whose normal has length 0
  ///          or a NaN counts as one without a normal.
  /// Throws as above, and Error{InvalidMesh} if there are not 3 #V numbers, or, naming the vertex, if a normal is
  /// infinite.
  [[nodiscard]] static Surface of_normals(const Index& index, std::span<const double> normals,
                                          const FacesView& faces = {});

  /// Returns the same surface for an index of the same mesh with other masks, or without: see `masked`. It shares all
  /// that is made. Takes O(1). Throws Error{InvalidOption} if the index is of another mesh.
  [[nodiscard]] Surface on(const Index& index) const;

  /// Follows a refit of its index: answers are then those of a new surface. With `changed`, boxes, normals and what
  /// patches need are renewed for the faces of these vertices alone, unless a vertex has left the frame of the index.
  /// They are copied if another surface shares them (see `on`), or a searcher that was made before. All else is made
  /// again when it is needed: so are patches where faces have more than three corners, or the index has walls. No
  /// thread may use the surface meanwhile.
  ///
  /// index    refitted in place, or a refitted copy.
  /// changed  ids of the vertices that have moved since, at least.
  /// Throws Error{InvalidOption} if the index is no refit of that of the surface, as one that was built again, or if
  /// the surface has normals of its own; Error{VertexOutOfRange}, naming the row of `changed`. The surface is then as
  /// it was.
  void refit_in_place(const Index& index);
  void refit_in_place(const Index& index, const IndicesView& changed);

  /// Return #V and #F.
  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::size_t face_count() const;

  /// Returns the memory without the index, in bytes, of all that has been made so far.
  [[nodiscard]] std::size_t bytes() const;

  /// Returns the point of the surface nearest to `point`. Of several faces at the same distance, the one with the
  /// smallest number; faces that meet at an edge or a vertex have the same distance there, bit for bit.
  ///
  /// The distance from a triangle is the least of those from its corners, its sides and the foot of the perpendicular,
  /// each computed in double: it is off by a few units in the last place of itself and of the longest side, whatever
  /// the shape. So beside sides of 10^19 in a mesh, a face that is nearer by less than ten thousand may be missed. A
  /// triangle without an area has only sides. Points on a side or at a corner have coordinates that are exactly 0.
  ///
  /// Throws Error{InvalidOption} if a coordinate is not finite or beyond 2^500, and Error{InvalidMesh} if no face has
  /// three corners. Takes O(log #V) on most surfaces; more where many triangles are about equally far. Allocates
  /// nothing.
  [[nodiscard]] SurfacePoint closest_point(const SpacePoint& point) const;

  /// Does the same for each of `points`. They are taken along a space-filling curve, and each search begins with the
  /// last answer, so that one takes about a third of the time of a single call. Needs 24 bytes a point. Throws as
  /// above, naming the row, and Error{Cancelled}.
  [[nodiscard]] std::vector<SurfacePoint> closest_points(std::span<const SpacePoint> points, const Run& run = {}) const;

  /// Calls `visit(row, point)` once for each row instead, in any order and on the threads of the call, several at a
  /// time: for a caller that keeps only a part of each answer. An exception of `visit` ends the call, and is passed on.
  void for_each_closest_point(std::span<const SpacePoint> points, const SurfacePointVisitor& visit,
                              const Run& run = {}) const;

  /// Returns the first point of the surface on the ray from `origin` along `direction`, seen from either side of a
  /// face; it is the origin if this lies on the surface. Of several faces at the same distance, the one with the
  /// smallest number; none (see `SurfacePoint`) if the ray meets nothing.
  ///
  /// direction  finite and not 0, of any length. The distance is in the unit of the positions.
  ///
  /// No ray slips through where faces meet. The place of a corner as the ray sees it is computed in double, off by a
  /// few units in the last place of its distance, and is the same for all faces; on which side of a line the ray passes
  /// is then decided exactly. A ray that meets a side or a corner meets all faces there: their distances are the same,
  /// bit for bit, and the coordinates of other corners are exactly 0. A triangle that the ray sees exactly from its
  /// side is not hit, but those that meet it are. The distance is off by a few units in the last place of those of the
  /// corners, times the slope of the triangle against the ray.
  ///
  /// Throws Error{InvalidOption} as `closest_point` for `origin`, and for `direction`, and Error{InvalidMesh} if no
  /// face has three corners. Takes O(log #V) on most surfaces; O(#F) from farther away than 10^14 times the mesh.
  /// Allocates nothing.
  [[nodiscard]] SurfacePoint first_hit(const SpacePoint& origin, const SpacePoint& direction) const;

  /// Does the same for each row of `origins` and `directions`. Throws as above, naming the row, Error{InvalidOption} if
  /// there are not as many directions as origins, and Error{Cancelled}.
  [[nodiscard]] std::vector<SurfacePoint> first_hits(std::span<const SpacePoint> origins,
                                                     std::span<const SpacePoint> directions, const Run& run = {}) const;

  /// Calls `visit(row, point)` once for each row instead, as `for_each_closest_point`.
  void for_each_first_hit(std::span<const SpacePoint> origins, std::span<const SpacePoint> directions,
                          const SurfacePointVisitor& visit, const Run& run = {}) const;

  /// Returns the faces with all corners in `ids`, or with at least one; ascending. A face without corners is never one.
  ///
  /// ids  vertices in [0, #V), in any order; repeats are allowed.
  /// Takes O(k log k), where k is the number of corners of the faces around `ids`, and #V bits, as for the calls below.
  /// Throws Error{VertexOutOfRange}, naming the position in `ids`.
  [[nodiscard]] std::vector<std::size_t> faces(std::span<const VertexId> ids, Corners corners = Corners::All) const;

  /// Returns these faces as a mesh. Its positions are those of `vertices`. With `Corners::All`, faces that the surface
  /// of the ball cuts are left out, and so is their area: see `PatchSearcher::clip`. Throws as `faces`.
  [[nodiscard]] Submesh submesh(std::span<const VertexId> ids, Corners corners = Corners::All) const;

  /// Returns where the surface leaves a region: `ids` is the region of `center` and `radius` (see `Searcher`).
  ///
  /// A point of the rim lies on an edge from a vertex of `ids` to one that is not, where the edge leaves the ball: its
  /// distance from `center` is `radius` up to the rounding of its coordinates. If the outer end lies inside the ball,
  /// as a wall does, the point is that end. A face joins the two points between which its boundary leaves the region
  /// and comes back. Where two of these segments meet, they belong to one polyline; where one, three or more meet, as
  /// on the border of a mesh or at a non-manifold edge, polylines end. On a manifold mesh without border, all polylines
  /// are loops. On consistently oriented faces the region lies to the left, seen from the side on which their corners
  /// run counterclockwise.
  ///
  /// A face with fewer than three corners adds nothing. Polylines, and the first point of a loop, come in a fixed order
  /// for each set of `ids`.
  ///
  /// Throws as `faces`, Error{InvalidRadius}, and Error{InvalidOption} if a coordinate of `center` is not finite or
  /// beyond 2^500, or a vertex of `ids` at the rim lies outside the ball.
  [[nodiscard]] Rim rim(std::span<const VertexId> ids, const SpacePoint& center, double radius) const;

  /// Returns the area of each vertex, #V in the caller's order (see `vertex_areas`). The areas are valid as long as the
  /// surface, or until it is refitted.
  [[nodiscard]] std::span<const double> vertex_areas() const&;
  [[nodiscard]] std::span<const double> vertex_areas() const&& = delete;

 private:
  friend struct SurfaceAccess;

  struct State;
  explicit Surface(std::unique_ptr<State> state);
  detail::Owner<State> state_;
};

/// Returns the index of a surface, with its masks, by whose paths (`Metric::Path`) distances are those along the
/// surface: a path has edges, and straight lines over two triangles that share a side, unfolded into a plane. It is
/// nearer to a geodesic than one along the edges (docs/queries.md). All calls by other metrics answer as before, and
/// `Surface::on` makes a surface of it.
///
/// A line crosses a side inside, and only one with exactly two opposite corners, however often a face is listed. None
/// runs over a face with a wall, or with a side that is cut (see `cut_edges`). The triangles of a polygon are those of
/// `Surface`; the sides between them are lines, too. The length of a line is computed in double, off by a few units in
/// the last place of the longest side.
///
/// The arrays of the index are shared. The lines take 150 bytes a vertex of a mesh of triangles, 12 for each line in
/// both directions and 4; three times that meanwhile, and what the surface needs for closest points. Takes O(#V + #F),
/// on one thread; `build/release/bench/bench_paths` compares the searches with those along the edges. The same holds
/// for it as for an index of `masked`: it is not saved, checked, refitted or masked, and refuses to answer after a
/// refit in place of its mesh.
///
/// Throws Error{InvalidMesh} if no face has three corners, Error{InvalidOption} after a refit in place, Error{TooLarge}
/// beyond `kMaxNeighbors`, and Error{Cancelled}. Connectome Workbench measures geodesic distances in this way.
[[nodiscard]] Index surface_paths(const Surface& surface, const Run& run = {});

/// How the thickness of a wall is measured, whose faces are oriented counterclockwise, seen from outside.
enum class ThicknessMethod : std::uint8_t {
  /// The way from the vertex against its normal (see curvature.h) to the surface.
  Ray,

  /// The diameter of the largest ball that touches the surface at the vertex from inside, and has no point of an
  /// opposite face in it. A face is opposite if its normal turns from that of the vertex by more than 53 degrees, the
  /// cosine of which is 0.6: on a curved wall, those beside the vertex lie inside every ball that touches there. The
  /// ball is found by shrinking (J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest neighbors
  /// and the normal field", The Visual Computer 28, 2012), but with the nearest points of faces.
  Sphere,
};

/// Returns the thickness at each of `vertices`, in the unit of the positions. Faces with the vertex as a corner do not
/// count, nor does what lies at the same place: no farther than 2^-46 times the largest coordinate of the vertex, or
/// of a corner of the face relative to the vertex. It is infinite where nothing else is met, or the radius of the ball
/// exceeds the diagonal of the box around the faces, and NaN for a vertex without a normal.
///
/// Masks have no effect. A row depends on the surface with its index, its vertex and the method alone, bit for bit.
/// Takes O(log #V) a row on most surfaces; for a ball, O(#F) where the whole surface is nearly a ball, all faces of
/// which it touches. Needs 24 bytes a row. Throws Error{VertexOutOfRange, Cancelled}, naming the row,
/// Error{InvalidOption} after a refit in place, and Error{InvalidMesh} if no face has three corners.
[[nodiscard]] std::vector<double> thickness(const Surface& surface, const BatchVertices& vertices = {},
                                            ThicknessMethod method = ThicknessMethod::Ray, const Run& run = {});

/// Does the same at points of faces, against the normals of these; of a polygon, that of its vector area. A face does
/// not count for its own points, nor do other faces for points on their sides, up to rounding. The thickness is NaN for
/// a face without an area.
///
/// faces   #rows numbers.
/// points  #rows. The point of the face nearest to each of them counts, in O(#corners of the face).
/// Throws as above, and Error{InvalidOption}, naming the row, for a face that the mesh does not have, or a coordinate
/// that is not finite or beyond 2^500; and if the numbers of rows differ. Needs at most 72 bytes a row.
[[nodiscard]] std::vector<double> thickness(const Surface& surface, const IndicesView& faces,
                                            std::span<const SpacePoint> points,
                                            ThicknessMethod method = ThicknessMethod::Ray, const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
