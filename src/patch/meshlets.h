// SPDX-License-Identifier: MIT
// The triangles of the faces of a mesh, and the meshlets that they form.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

#include "base/frame.h"
#include "base/lists.h"
#include "base/vector.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "shared/distance.h"
#include "surface/box_tree.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {

/// A triangle, by its number. Those of a meshlet follow each other.
using TriangleId = std::uint32_t;
using MeshletId = std::uint32_t;

/// The triangles of the faces of a mesh, and which of them meet.
///
/// A face with a wall, or with fewer than three corners, has none. A *side* joins two corners. A diagonal of a polygon
/// is a side of its own, even where another face has the same corners. A *meshlet* is a set of triangles that are
/// joined by corners; the first corners, in index order, of their faces are in one leaf.
struct Triangles {
  std::vector<std::array<std::uint32_t, 3>> corners;  // places in index order
  std::vector<std::uint32_t> face;                    // of each: its number in the mesh
  std::vector<std::uint8_t> flags;                    // bits 0 to 2: the sides at borders; 3 to 5: diagonals
  Lists<TriangleId> fans;                             // the triangles at each place, ascending
  std::vector<TriangleId> first_of_meshlet;           // by meshlet, and one more
  std::vector<MeshletId> of_block;                    // the meshlet of each eighth triangle
  bool are_of_index = true;                           // whether each side that is no diagonal is an edge of the index

  /// The places of an edge of the index that is no side: between faces with walls, or of a face of two corners.
  struct LooseEdge {
    std::uint32_t first;
    std::uint32_t last;
  };
  std::vector<LooseEdge> loose;  // ascending

  /// There are none if every face has a wall. Throws Error{InvalidMesh} if no face has a triangle, Error{TooLarge}
  /// beyond 2^32 / 3 triangles, and Error{Cancelled}.
  Triangles(const IndexView& index, const StoredFaces& faces, TaskContext& task);

  [[nodiscard]] std::size_t size() const { return corners.size(); }
  [[nodiscard]] std::size_t bytes() const;

  /// Returns the triangles of a meshlet.
  [[nodiscard]] auto of_meshlet(MeshletId meshlet) const {
    return std::views::iota(first_of_meshlet[meshlet], first_of_meshlet[meshlet + std::size_t{1}]);
  }

  /// The first step has no branch, because it could not be predicted. More steps are rare.
  [[nodiscard]] MeshletId meshlet_of(TriangleId t) const {
    MeshletId meshlet = of_block[t / kBlock];
    meshlet += static_cast<MeshletId>(first_of_meshlet[meshlet + std::size_t{1}] <= t);
    while (first_of_meshlet[meshlet + std::size_t{1}] <= t) ++meshlet;
    return meshlet;
  }

  /// Returns twice the sum of the vector areas of some triangles, in the frame.
  [[nodiscard]] Point normal_of(const IndexView& index, std::span<const TriangleId> some) const;

  /// Returns whether a side does not have as many triangles in one direction as in the other, or one twice: at a border
  /// of the surface, where its orientation changes, or where a face is listed again.
  [[nodiscard]] bool is_border(TriangleId t, unsigned side) const { return (flags[t] >> side & 1U) != 0; }
  [[nodiscard]] bool is_diagonal(TriangleId t, unsigned side) const { return (flags[t] >> (3 + side) & 1U) != 0; }
  [[nodiscard]] bool has_border(TriangleId t) const { return (flags[t] & 7U) != 0; }

  /// Calls `visit` with each other triangle at a side, ascending. The fan of one of its ends is searched: the smaller,
  /// because all sides of a vertex in many triangles may be asked for.
  template <class Visit>
  void for_each_beside(TriangleId t, std::size_t side, Visit&& visit) const {
    const Side wanted = side_of(t, side);
    const auto a = fans[wanted.first];
    const auto b = fans[wanted.last];
    for (const TriangleId other : a.size() < b.size() ? a : b) {
      if (other == t) continue;
      if (side_of(other, 0) == wanted || side_of(other, 1) == wanted || side_of(other, 2) == wanted) visit(other);
    }
  }

 private:
  static constexpr TriangleId kBlock = 8;

  /// The ends of a side, ascending, and the face of a diagonal, or `kShared` for other sides.
  struct Side {
    static constexpr std::uint32_t kShared = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t owner;

    bool operator==(const Side&) const = default;
  };

  struct GivenSide {
    Side side;
    std::pair<bool, std::uint32_t> way;  // whether it is from its first end on in the triangle; and the third corner
    TriangleId triangle;
    std::uint32_t number;  // of the side there
  };

  [[nodiscard]] Side side_of(TriangleId t, std::size_t i) const {
    const auto [first, last] = std::minmax(corners[t][i], corners[t][(i + 1) % 3]);
    return {first, last, is_diagonal(t, static_cast<unsigned>(i)) ? face[t] : Side::kShared};
  }

  /// `all` has the triangles by leaf.
  void make_meshlets(const Lists<Triangle, std::size_t>& all, TaskContext& task);
  void make_fans(std::size_t places);
  void find_borders(const IndexView& index, TaskContext& task);

  /// Finds the sides whose first end is the place `first`, sorted so that the same ones follow each other.
  void gather_sides(std::uint32_t first, std::vector<GivenSide>& sides) const;

  /// Returns whether the triangles at one side are as many in one direction as in the other, and each is listed once.
  [[nodiscard]] static bool are_balanced(std::span<const GivenSide> same);
};

/// Sums over the triangles of a meshlet. Lengths are in the frame, points in the unit of the mesh.
struct Meshlet {
  BoundingBox box;
  double radius;  // of a bounding sphere about the center
  double area;
  Point vector_area;  // the sum of area times normal
  double moment;      // the sum of area times the distance of the plane from `center`, along the normal
  bool has_border;

  [[nodiscard]] Point center() const { return 0.5 * box.low + 0.5 * box.high; }
};

/// The meshlets of a surface. A search takes or leaves out a whole one if it lies inside a ball or far away.
struct Meshlets {
  std::vector<Meshlet> meshlets;
  Lists<std::uint32_t> corners;  // the places at each meshlet, ascending
  Lists<MeshletId> of_leaf;      // those with a corner in it, ascending
  BoxTree boxes;                 // of the meshlets

  Meshlets(const IndexView& index, const Triangles& triangles, TaskContext& task);

  /// Updates the sums after the vertices `changed` have moved, within the same frame.
  void renew(const IndexView& index, const Triangles& triangles, std::span<const VertexId> changed);

  [[nodiscard]] std::size_t size() const { return meshlets.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return meshlets.size() * sizeof(Meshlet) + corners.bytes() + of_leaf.bytes() + boxes.bytes();
  }
};

/// What all searches of the patches of a surface share. The walls of the index are left out.
struct PatchState {
  /// Borrows the faces. Throws as `Triangles`.
  PatchState(const Index& given, const StoredFaces& all, TaskContext& task);

  /// Shares the triangles with `other`.
  PatchState(const PatchState& other);
  PatchState(PatchState&&) = default;
  PatchState& operator=(const PatchState&) = delete;
  PatchState& operator=(PatchState&&) = delete;
  ~PatchState() = default;

  /// Follows a refit, in the same frame, in which the vertices `changed` have moved. All faces must have three corners.
  void renew(const Index& refitted, std::span<const VertexId> changed);

  Index searched;  // answers with ignored vertices, too, which are on the surface as others are
  const IndexView* index;
  const StoredFaces* faces;
  std::shared_ptr<const Triangles> kept_triangles;
  const Triangles& triangles = *kept_triangles;
  Meshlets meshlets;

  /// Returns whether the vertices of a patch that are in its ball are the neighborhood of its center, but for loose
  /// edges, diagonals, and sides that dip into the ball.
  [[nodiscard]] bool follows_neighborhoods() const { return triangles.are_of_index; }

  [[nodiscard]] std::size_t bytes() const { return triangles.bytes() + meshlets.bytes(); }
};

}  // namespace meshhood::inline v0_1
