// SPDX-License-Identifier: MIT
// The surface: its faces, points on them, and the thickness of its walls. `use_faces` comes first.
#include <cstddef>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "face_hash.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

/// Returns the face. The ids of the answer are the vertices of its triangle; the reals are their three weights, the
/// point and its distance.
std::size_t answer_with(const SurfacePoint& found) {
  answer.ids.assign(found.vertices.begin(), found.vertices.end());
  answer.reals.assign(found.weights.begin(), found.weights.end());
  answer.reals.insert(answer.reals.end(), found.point.begin(), found.point.end());
  answer.reals.push_back(found.distance);
  return found.face;
}

}  // namespace

extern "C" {

[[clang::export_name("use_faces")]] void use_faces(const void* corners, std::size_t corner_count, bool signed_corners,
                                                   const void* offsets, std::size_t offset_count, bool signed_offsets) {
  workspace.use_faces(view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets),
                      hash_faces(corners, corner_count, offsets, offset_count));
}

[[clang::export_name("closest_point")]] std::size_t closest_point(double x, double y, double z) {
  return answer_with(workspace.surface().closest_point({x, y, z}));
}

/// The distance is infinite if the ray meets nothing.
[[clang::export_name("first_hit")]] std::size_t first_hit(double x, double y, double z, double along_x, double along_y,
                                                          double along_z) {
  return answer_with(workspace.surface().first_hit({x, y, z}, {along_x, along_y, along_z}));
}

[[clang::export_name("thickness")]] void thickness(const VertexId* vertices, std::size_t vertex_count,
                                                   ThicknessMethod method) {
  answer.reals = meshhood::thickness(workspace.surface(), view_vertices(vertices, vertex_count), method);
}

}  // extern "C"

}  // namespace meshhood::wasm
