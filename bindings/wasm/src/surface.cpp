// SPDX-License-Identifier: MIT
// The surface: its faces, points on them, and the thickness of its walls. `use_faces` comes first.
#include <cstddef>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "face_hash.h"
#include "workspace.h"

namespace meshhood::wasm {

extern "C" {

[[clang::export_name("use_faces")]] void use_faces(const void* corners, std::size_t corner_count, bool signed_corners,
                                                   const void* offsets, std::size_t offset_count, bool signed_offsets) {
  workspace.use_faces(view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets),
                      hash_faces(corners, corner_count, offsets, offset_count));
}

/// See `append_point`.
[[clang::export_name("closest_point")]] void closest_point(double x, double y, double z) {
  answer = {};
  append_point(workspace.surface().closest_point({x, y, z}));
}

/// The same; the distance is infinite if the ray meets nothing.
[[clang::export_name("first_hit")]] void first_hit(double x, double y, double z, double along_x, double along_y,
                                                   double along_z) {
  answer = {};
  append_point(workspace.surface().first_hit({x, y, z}, {along_x, along_y, along_z}));
}

[[clang::export_name("thickness")]] void thickness(const VertexId* vertices, std::size_t vertex_count,
                                                   ThicknessMethod method) {
  answer.reals = meshhood::thickness(workspace.surface(), view_vertices(vertices, vertex_count), method);
}

}  // extern "C"

}  // namespace meshhood::wasm
