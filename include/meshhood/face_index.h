// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/start.h"

namespace meshhood {

/// A point on a face.
struct SurfacePoint {
  std::size_t face;                  ///< its number
  std::size_t second_corner;         ///< of the fan of the face: the triangle of its corners 0, this one and the next
  std::array<VertexId, 3> vertices;  ///< of this triangle
  std::array<double, 3> weights;     ///< barycentric coordinates in it: >= 0, with the sum 1 up to rounding
  SpacePoint point;
  double distance;  ///< from the point that was asked for

  /// The search from the corners of the triangle, with the point as center: what a click on a surface gives. Borrows
  /// from this object.
  [[nodiscard]] Start start() const& { return {point, vertices}; }
  [[nodiscard]] Start start() const&& = delete;
};

/// The faces of a mesh by the tree of its index, to find the point of the surface nearest to a point in space.
///
///     const auto surface = meshhood::FaceIndex::build(index, faces);
///     const auto hit = surface.closest_point({0.1, 0.2, 0.3});
///     searcher.region(hit.start(), 1.5, ids);
///
/// A polygon is the fan of the triangles of its corners 0, i and i + 1. A face with fewer than three corners has no
/// points. Each face belongs to the leaf of its first corner in index order, and the bounding spheres of the nodes are
/// enlarged by what overhangs.
///
/// Immutable: any number of threads may use it. Shares the memory of the index, as a searcher does: the index may be
/// moved or destroyed. After `refit` it is to be built again. 24 bytes a triangle, 4 a leaf, and 4
/// for each node of the tree.
class FaceIndex {
 public:
  /// faces   those of the mesh that the index was built from; borrowed for the call.
  /// Throws Error{InvalidMesh, TooLarge} if they are invalid (see `validate`), or if none has three corners.
  /// O(#V + #corners), and for a face that is large beside the leaves O(log #V).
  [[nodiscard]] static FaceIndex build(const Index& index, const FacesView& faces);

  /// #F.
  [[nodiscard]] std::size_t face_count() const;

  /// Memory without the index, in bytes.
  [[nodiscard]] std::size_t bytes() const;

  /// The point of the surface nearest to `point`. Of several faces at the same distance, the one with the smallest
  /// number; faces that meet at an edge or a vertex have the same distance there, bit for bit.
  ///
  /// The distance from a triangle is the least of those from its corners, its sides and the foot of the perpendicular,
  /// each computed in double: it is off by a few units in the last place of itself and of the longest side, whatever
  /// the shape. So beside sides of 10^19 in a mesh, a face that is nearer by less than ten thousand may be missed. A
  /// triangle without an area has only sides. Points on a side or at a corner have weights that are exactly 0.
  ///
  /// Throws Error{InvalidOption} if a coordinate is not finite or beyond 2^500, or after a refit in place.
  /// O(log #V) on most surfaces; more where faces are large beside the leaves. Allocates nothing.
  [[nodiscard]] SurfacePoint closest_point(const SpacePoint& point) const;

  /// The same for each of `points`. Throws as above, naming the row, and Error{Cancelled}.
  [[nodiscard]] std::vector<SurfacePoint> closest_points(std::span<const SpacePoint> points, const Run& run = {}) const;

 private:
  struct State;
  class Search;
  explicit FaceIndex(std::unique_ptr<const State> state);
  detail::Owner<const State> state_;
};

}  // namespace meshhood
