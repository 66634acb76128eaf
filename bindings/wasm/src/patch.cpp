// SPDX-License-Identifier: MIT
// The surface in a ball. `use_faces` comes first, and `search_by` for the masks.
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

PatchStart patch_start = VertexId{0};

void answer_faces(const std::vector<std::size_t>& faces) { answer.counts.assign(faces.begin(), faces.end()); }

}  // namespace

/// The reals are all areas, and then all volumes: of the rows, or, unless `points` is null, of a point for each face
/// with the radii of the rows.
[[clang::export_name("invariants")]] void invariants(const VertexId* faces, std::size_t face_count,
                                                     const SpacePoint* points) {
  const std::span numbers(faces, face_count);
  Invariants found = points == nullptr
                         ? meshhood::invariants(workspace.surface(), rows)
                         : meshhood::invariants(workspace.surface(), numbers, {points, face_count}, rows.radius);
  answer.reals = std::move(found.area);
  answer.reals.insert(answer.reals.end(), found.volume.begin(), found.volume.end());
}

/// Of the same. The counts are the faces, and the ids the three vertices of each row. The reals are seven for each row:
/// the weights, the point and the distance.
[[clang::export_name("gaps")]] void gaps(const VertexId* faces, std::size_t face_count, const SpacePoint* points) {
  const std::span numbers(faces, face_count);
  const std::vector<SurfacePoint> found =
      points == nullptr ? meshhood::gaps(workspace.surface(), rows)
                        : meshhood::gaps(workspace.surface(), numbers, {points, face_count}, rows.radius);
  answer = {};
  for (const SurfacePoint& gap : found) append_point(gap);
}

/// Where the patches that follow start.
[[clang::export_name("patch_at_vertex")]] void patch_at_vertex(VertexId v) { patch_start = v; }
[[clang::export_name("patch_at_point")]] void patch_at_point(std::size_t face, double x, double y, double z) {
  patch_start = {face, {x, y, z}};
}

/// The counts are the faces of the patch.
[[clang::export_name("patch")]] void patch(double radius) {
  answer_faces(workspace.patch_searcher().patch(patch_start, radius));
}

/// The counts are the faces of the triangles; the ids three vertices for each point, and then the triangles; the reals
/// the points, their weights and the area.
[[clang::export_name("clip")]] void clip(double radius, double tolerance) {
  const ClippedMesh mesh = workspace.patch_searcher().clip(patch_start, radius, tolerance);
  answer = {};
  answer_faces(mesh.faces);
  append_rows(answer.ids, mesh.vertices);
  append_rows(answer.ids, mesh.triangles);
  append_rows(answer.reals, mesh.points);
  append_rows(answer.reals, mesh.weights);
  answer.reals.push_back(mesh.area);
}

/// The reals are the area and the volume.
[[clang::export_name("measure")]] void measure(double radius) {
  const PatchMeasure found = workspace.patch_searcher().measure(patch_start, radius);
  answer.reals = {found.area, found.volume};
}

/// See `append_point`; the distance is infinite if there is none.
[[clang::export_name("gap")]] void gap(double radius) {
  answer = {};
  append_point(workspace.patch_searcher().gap(patch_start, radius));
}

}  // namespace meshhood::wasm
