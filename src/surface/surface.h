// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/surface.h"

#include "base/lists.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "patch/meshlets.h"
#include "shared/distance.h"
#include "shared/kept.h"
#include "shared/raw_vector.h"
#include "surface/face_tree.h"

namespace meshhood::inline v0_1 {

class TaskContext;

/// The faces that have each vertex as a corner, ascending; a face twice if the vertex is two corners of it.
using FaceLists = Lists<std::uint32_t, std::uint64_t>;

/// The faces of a surface, whatever the positions.
struct SurfaceFaces {
  FaceArrays arrays;
  StoredFaces faces;  // the same
  Kept<FaceLists> lists;

  explicit SurfaceFaces(FaceArrays given) : arrays(std::move(given)), faces{arrays.corners, arrays.offsets} {}
};

/// Unit vectors in index order, NaN for a vertex without a normal.
struct Normals {
  RawVector<double> x;
  RawVector<double> y;
  RawVector<double> z;

  explicit Normals(std::size_t vertices) : x(vertices), y(vertices), z(vertices) {}

  /// Sets a normal; one of length 0 becomes NaN.
  void set(std::size_t place, const Point& n);
};

/// What follows from the faces and the positions.
struct SurfaceGeometry {
  Kept<Normals> normals;
  Kept<FaceTree> tree;
  Kept<NormalCones> cones;  // of the tree
  Kept<std::vector<double>> areas;
  Kept<PatchState> patches;  // without walls

  /// Copies what a refit renews.
  [[nodiscard]] std::shared_ptr<SurfaceGeometry> copy() const;
};

/// Surfaces of one mesh with other masks share the faces and the geometry.
struct Surface::State {
  Index searched;    // is never refitted. If the caller's index is, in place, `check_current` of `index` throws
  BoundIndex index;  // its arrays
  Frame frame;       // of the geometry
  std::shared_ptr<SurfaceFaces> topology;
  std::shared_ptr<SurfaceGeometry> geometry;
  mutable Kept<PatchState> walled_patches;  // of this index
  bool has_own_normals = false;             // which do not follow from faces

  State(const Index& given, FaceArrays faces);
  State(const Index& given, const State& other);

  [[nodiscard]] const StoredFaces& faces() const { return topology->faces; }
  [[nodiscard]] const FaceLists& lists() const;
  [[nodiscard]] const FaceTree& tree(TaskContext& task) const;
  [[nodiscard]] const NormalCones& cones(TaskContext& task) const;
  [[nodiscard]] const Normals& normals(TaskContext& task) const;
  [[nodiscard]] const std::vector<double>& areas() const;
  [[nodiscard]] const PatchState& patches(TaskContext& task) const;
  [[nodiscard]] Kept<PatchState>& kept_patches() const;

  /// Throws Error{InvalidOption} unless `other` is a refit of the index.
  void check_refit(const Index& other) const;

  /// Renews what has been made, after the vertices `changed` have moved.
  void renew(SurfaceGeometry& made, std::span<const VertexId> changed) const;
};

/// The index of a surface with the normals of the vertices.
struct OrientedIndex {
  const Index* searched;
  const IndexView* index;
  const Normals* normals;

  [[nodiscard]] Point position(std::size_t place) const { return index->position(place); }
  [[nodiscard]] Point normal(std::size_t place) const {
    return {normals->x[place], normals->y[place], normals->z[place]};
  }

  /// Returns the neighbor with the lowest id; the vertex itself if it has none.
  [[nodiscard]] std::size_t first_neighbor(std::size_t place) const;
};

/// Gives access to the state of a surface: to the sources of surfaces and curvature, and to tests.
struct SurfaceAccess {
  using State = Surface::State;

  /// Throws Error{InvalidOption} after a refit in place.
  [[nodiscard]] static const State& state(const Surface& surface) {
    surface.state_->index.check_current();
    return *surface.state_;
  }

  /// Keeps the state alive. Throws likewise.
  [[nodiscard]] static std::shared_ptr<const State> share(const Surface& surface) {
    static_cast<void>(state(surface));
    return surface.state_.share();
  }

  /// Makes the normals if there are none. Throws likewise, and Error{InvalidMesh} if there are no faces.
  [[nodiscard]] static OrientedIndex oriented(const Surface& surface, TaskContext& task) {
    const State& all = state(surface);
    return {&all.searched, &*all.index, &all.normals(task)};
  }
  [[nodiscard]] static OrientedIndex oriented(const Surface& surface, unsigned threads = 1);
};

using SurfaceState = SurfaceAccess::State;

/// Returns where the segment from `inside`, in the ball, to `outside` leaves it; `outside` if that is inside, too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

/// Returns the normals of the vertices of faces.
[[nodiscard]] Normals make_normals(const IndexView& index, const FacesView& faces, TaskContext& task);

/// Renews the normals of some vertices.
void renew_normals(const IndexView& index, const StoredFaces& faces, const FaceLists& lists,
                   std::span<const VertexId> vertices, Normals& normals);

/// Reads the normals of the caller's vertices, three numbers each. Throws as `Surface::of_normals`.
[[nodiscard]] Normals read_normals(const IndexView& index, std::span<const double> normals);

}  // namespace meshhood::inline v0_1
