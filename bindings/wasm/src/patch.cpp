// SPDX-License-Identifier: MIT
// The surface in a ball. `use_faces` comes first, and `search_by` for the masks.
#include <cstddef>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "rows.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

void answer_faces(const std::vector<std::size_t>& faces) { answer.counts.assign(faces.begin(), faces.end()); }

}  // namespace

extern "C" {

/// See `RowArguments`. The reals are all areas, and then all volumes.
[[clang::export_name("invariants")]] void invariants(const VertexId* vertices, std::size_t vertex_count, double radius,
                                                     const double* radii, std::size_t radius_count, bool are_scales) {
  const RowArguments rows{vertices, vertex_count, radius, radii, radius_count, are_scales};
  Invariants found = meshhood::invariants(workspace.surface(), rows.query());
  answer.reals = std::move(found.area);
  answer.reals.insert(answer.reals.end(), found.volume.begin(), found.volume.end());
}

/// See `RowArguments`. The counts are the faces, and the ids the three vertices of each row. The reals are seven for
/// each row: the weights, the point and the distance.
[[clang::export_name("gaps")]] void gaps(const VertexId* vertices, std::size_t vertex_count, double radius,
                                         const double* radii, std::size_t radius_count, bool are_scales) {
  const RowArguments rows{vertices, vertex_count, radius, radii, radius_count, are_scales};
  answer = {};
  for (const SurfacePoint& gap : meshhood::gaps(workspace.surface(), rows.query())) append_point(gap);
}

/// The counts are the faces of the patch.
[[clang::export_name("patch_of_vertex")]] void patch_of_vertex(VertexId v, double radius) {
  answer_faces(workspace.patch_searcher().patch(v, radius));
}

[[clang::export_name("patch_of_point")]] void patch_of_point(double face, double x, double y, double z, double radius) {
  answer_faces(workspace.patch_searcher().patch({to_size(face), {x, y, z}}, radius));
}

}  // extern "C"

}  // namespace meshhood::wasm
