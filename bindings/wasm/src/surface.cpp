// SPDX-License-Identifier: MIT
// The surface: its faces, points on them, and the thickness of its walls. `use_faces` comes first.
#include <cstddef>

#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's own
#include <xxhash.h>

#include "meshhood/fingerprint.h"
#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

namespace {

/// Of the bytes of the corners and the offsets, in their order: `meshhood::fingerprint` does not see which way round a
/// face is, on which its normal depends.
Fingerprint hash_faces(const FacesView& faces) {
  const std::size_t corner_count = faces.corners().size();
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, &corner_count, sizeof corner_count);
  for (const IndicesView& indices : {faces.corners(), faces.offsets()}) {
    indices.visit([&](auto values) { XXH3_128bits_update(&state, values.data(), values.size_bytes()); });
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return {.high = hash.high64, .low = hash.low64};
}

}  // namespace

extern "C" {

[[clang::export_name("use_faces")]] void use_faces() { workspace.use_faces(given.faces, hash_faces(given.faces)); }

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

/// A point for each face.
[[clang::export_name("thickness_of_points")]] void thickness_of_points(const VertexId* faces, std::size_t face_count,
                                                                       const SpacePoint* points,
                                                                       ThicknessMethod method) {
  const std::span numbers(faces, face_count);
  answer.reals = meshhood::thickness(workspace.surface(), numbers, {points, face_count}, method);
}

}  // extern "C"

}  // namespace meshhood::wasm
