// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/start.h"

namespace meshhood {

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

/// The part of a surface inside a ball, as a mesh of its own. Its points in space are new ones.
struct ClippedMesh {
  std::vector<SpacePoint> points;
  std::vector<std::array<VertexId, 2>>
      edges;                           ///< of each point: twice the same vertex, or the ends of its edge as for `Rim`
  std::vector<std::size_t> faces;      ///< of each polygon: the number of the face it is a part of; ascending
  std::vector<std::uint64_t> offsets;  ///< #polygons + 1: polygon `i` has the corners from `offsets[i]` on
  std::vector<VertexId> corners;       ///< as positions in `points`
  double area = 0;                     ///< of all polygons, as `vertex_areas` measures it

  /// Borrows from this object. A view of a temporary does not compile.
  [[nodiscard]] MeshView view() const& { return {points, FacesView::polygons(offsets, corners)}; }
  [[nodiscard]] MeshView view() const&& = delete;
};

/// The lines along which a surface leaves a ball.
struct Rim {
  std::vector<SpacePoint> points;              ///< of all polylines, one after the other
  std::vector<std::array<VertexId, 2>> edges;  ///< of each point: the end of its edge inside the region, and the other
  std::vector<std::size_t> offsets;            ///< #polylines + 1: the first point of each polyline
  std::vector<std::uint8_t> closed;            ///< of each polyline, 1: a loop, whose last point is joined to its first

  /// The number of polylines.
  [[nodiscard]] std::size_t size() const { return closed.size(); }
};

/// Makes meshes and outlines of the regions of a mesh, for drawing, remeshing and patches. Owns the faces and, for each
/// vertex, the list of its faces: about 24 bytes per corner. The positions are borrowed, and must outlive it.
///
/// ids     vertices in [0, #V), in any order; repeats are allowed.
/// A call costs O(k log k), where k is the number of corners of the faces around `ids`. Use one object per thread: it
/// owns 4 bytes of scratch memory per vertex.
///
/// Throws Error{VertexOutOfRange}, naming the position in `ids`.
class RegionMesher {
 public:
  /// Throws Error{InvalidMesh, TooLarge}. O(#V + #corners).
  explicit RegionMesher(const MeshView& mesh);

  /// #V, #F.
  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::size_t face_count() const;

  /// The faces with all corners in `ids`, or with at least one; ascending. A face without corners is never one.
  [[nodiscard]] std::vector<std::size_t> faces(std::span<const VertexId> ids, Corners corners = Corners::All);

  /// These faces as a mesh. Its positions are those of `vertices`. With `Corners::All`, faces that the surface of the
  /// ball cuts are left out, and so is their area: see `clip`.
  [[nodiscard]] Submesh submesh(std::span<const VertexId> ids, Corners corners = Corners::All);

  /// The part of the surface inside a ball: `ids` is the region of `center` and `radius` (see `Searcher`).
  ///
  /// Faces with all corners in `ids` are whole. A face with only some is cut on its sides: where one leads from a
  /// vertex of `ids` to another one, it ends at the point of the rim (see `rim`). Two such points of a face are joined
  /// by a straight chord, not along the sphere, so that the area is a little too small. Corners of a polygon in `ids`
  /// with others between them make a polygon for each run of corners. What of a face lies in the ball without a corner
  /// in `ids` is left out.
  ///
  /// Points: the vertices, ascending, then those on edges by `edges`. A face with fewer than three corners adds
  /// nothing. Throws as `rim`.
  [[nodiscard]] ClippedMesh clip(std::span<const VertexId> ids, const SpacePoint& center, double radius);

  /// Where the surface leaves a region: `ids` is the region of `center` and `radius` (see `Searcher`).
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
  /// Throws also Error{InvalidRadius}, and Error{InvalidOption} if a coordinate of `center` is not finite or a vertex
  /// of `ids` at the rim lies outside the ball.
  [[nodiscard]] Rim rim(std::span<const VertexId> ids, const SpacePoint& center, double radius);

 private:
  struct State;
  detail::Owner<State> state_;
};

}  // namespace meshhood
