// SPDX-License-Identifier: MIT
// Curvature at a scale. One of the two `use_...` comes first.
#include <array>
#include <cstddef>
#include <span>

#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's own
#include <xxhash.h>

#include "meshhood/meshhood.h"

#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

Curvatures last_curvatures;

/// Of the bytes of the corners and the offsets, in their order: `meshhood::fingerprint` does not see which way round a
/// face is, on which its normal depends.
Fingerprint hash_faces(const void* corners, std::size_t corner_count, const void* offsets, std::size_t offset_count) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, &corner_count, sizeof corner_count);
  XXH3_128bits_update(&state, corners, 4 * corner_count);
  XXH3_128bits_update(&state, offsets, 4 * offset_count);
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return {.high = hash.high64, .low = hash.low64};
}

}  // namespace

extern "C" {

[[clang::export_name("use_normals_of_faces")]] void use_normals_of_faces(const void* corners, std::size_t corner_count,
                                                                         bool signed_corners, const void* offsets,
                                                                         std::size_t offset_count,
                                                                         bool signed_offsets) {
  workspace.use_faces(view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets),
                      hash_faces(corners, corner_count, offsets, offset_count));
}

[[clang::export_name("use_normals")]] void use_normals(const double* normals, std::size_t scalars) {
  workspace.use_normals({normals, scalars});
}

/// All vertices if `vertices` is null.
[[clang::export_name("curvature")]] void curvature(const VertexId* vertices, std::size_t vertex_count, double radius,
                                                   CurvatureFit fit, bool filter, bool is_like_libigl) {
  CurvatureOptions options = is_like_libigl ? like_libigl() : CurvatureOptions{};
  options.fit = fit;
  options.filter = filter;
  last_curvatures =
      curvatures(workspace.surface(), {.vertices = view_vertices(vertices, vertex_count), .radius = radius}, options);
}

[[clang::export_name("curvature_rows")]] std::size_t curvature_rows() { return last_curvatures.state.size(); }

/// `which` is 0 for k1, 1 for k2, 2 for d1 and 3 for d2.
[[clang::export_name("curvature_reals")]] const double* curvature_reals(std::size_t which) {
  const Curvatures& last = last_curvatures;
  const std::array arrays{last.k1.data(), last.k2.data(), last.d1.data(), last.d2.data()};
  return arrays[which];
}

[[clang::export_name("curvature_states")]] const CurvatureState* curvature_states() {
  return last_curvatures.state.data();
}

[[clang::export_name("release_curvature")]] void release_curvature() { last_curvatures = {}; }

}  // extern "C"

}  // namespace meshhood::wasm
