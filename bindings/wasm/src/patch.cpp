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

/// All areas, and then all volumes.
void answer_invariants(Invariants found) {
  answer.reals = std::move(found.area);
  answer.reals.insert(answer.reals.end(), found.volume.begin(), found.volume.end());
}

void answer_gaps(const std::vector<SurfacePoint>& gaps) {
  answer = {};
  for (const SurfacePoint& gap : gaps) append_point(gap);
}

void answer_faces(const std::vector<std::size_t>& faces) { answer.counts.assign(faces.begin(), faces.end()); }

}  // namespace

/// See `answer_invariants`.
[[clang::export_name("invariants")]] void invariants() {
  answer_invariants(meshhood::invariants(workspace.surface(), rows));
}

/// The same of a point for each face, with the radii of the rows.
[[clang::export_name("invariants_of_points")]] void invariants_of_points(const VertexId* faces, std::size_t face_count,
                                                                         const SpacePoint* points) {
  const std::span numbers(faces, face_count);
  answer_invariants(meshhood::invariants(workspace.surface(), numbers, {points, face_count}, rows.radius));
}

/// The counts are the faces, and the ids the three vertices of each row. The reals are seven for each row: the weights,
/// the point and the distance.
[[clang::export_name("gaps")]] void gaps() { answer_gaps(meshhood::gaps(workspace.surface(), rows)); }

/// The same of a point for each face, with the radii of the rows.
[[clang::export_name("gaps_of_points")]] void gaps_of_points(const VertexId* faces, std::size_t face_count,
                                                             const SpacePoint* points) {
  const std::span numbers(faces, face_count);
  answer_gaps(meshhood::gaps(workspace.surface(), numbers, {points, face_count}, rows.radius));
}

/// Where the patches that follow start.
[[clang::export_name("patch_at_vertex")]] void patch_at_vertex(VertexId v) { patch_start = v; }
[[clang::export_name("patch_at_point")]] void patch_at_point(double face, double x, double y, double z) {
  patch_start = {to_size(face), {x, y, z}};
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
