// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/vector.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "patch/triangles.h"
#include "shared/distance.h"
#include "surface/box_tree.h"

namespace meshhood::inline v0_1 {

/// Sums over the triangles of a meshlet. Lengths are in the frame, points in the unit of the mesh.
struct Meshlet {
  BoundingBox box;
  double radius;  // of a bounding sphere about the center
  double area;
  Point vector_area;           // the sum of area times normal
  double moment;               // the sum of area times the distance of the plane from `center`, along the normal
  std::uint32_t first_corner;  // in `Meshlets::corners`
  bool has_border;

  [[nodiscard]] Point center() const { return 0.5 * box.low + 0.5 * box.high; }
};

/// What a search takes at once where it lies inside a ball, and finds at once where it lies far away.
struct Meshlets {
  std::vector<Meshlet> meshlets;             // and one more, for the end of the last corners
  std::vector<std::uint32_t> corners;        // the places at each meshlet, ascending
  std::vector<std::uint32_t> first_of_leaf;  // by leaf, and one more: in `of_leaf`
  std::vector<MeshletId> of_leaf;            // those with a corner in it, ascending
  BoxTree boxes;                             // of the meshlets

  Meshlets(const IndexView& index, const Triangles& triangles);

  [[nodiscard]] std::size_t bytes() const;

  [[nodiscard]] std::size_t size() const { return meshlets.size() - 1; }

  [[nodiscard]] std::span<const std::uint32_t> corners_of(MeshletId meshlet) const {
    return std::span(corners).subspan(meshlets[meshlet].first_corner,
                                      meshlets[meshlet + std::size_t{1}].first_corner - meshlets[meshlet].first_corner);
  }

  [[nodiscard]] std::span<const MeshletId> at_leaf(LeafId leaf) const {
    return std::span(of_leaf).subspan(first_of_leaf[leaf], first_of_leaf[leaf + std::size_t{1}] - first_of_leaf[leaf]);
  }

 private:
  void add(const IndexView& index, const Triangles& triangles, MeshletId meshlet);
  void list_by_leaf(const IndexView& index);
};

/// What all searches of the patches of a surface share. The walls of the index are left out.
struct PatchState {
  /// Borrows the faces.
  PatchState(const Index& given, const StoredFaces& all);

  Index searched;  // answers with ignored vertices, too, which are on the surface as others are
  const IndexView* index;
  const StoredFaces* faces;
  Triangles triangles;
  Meshlets meshlets;

  /// Whether the vertices of a patch that are in its ball are the neighborhood of its center, but for loose edges,
  /// diagonals, and sides that dip into the ball.
  [[nodiscard]] bool follows_neighborhoods() const { return triangles.are_of_index; }

  [[nodiscard]] std::size_t bytes() const { return triangles.bytes() + meshlets.bytes(); }
};

}  // namespace meshhood::inline v0_1
