// SPDX-License-Identifier: MIT
// The point of the surface nearest to a point in space.
#include <array>
#include <cstddef>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "face_hash.h"
#include "workspace.h"

namespace meshhood::wasm {

extern "C" {

/// Returns the face. The ids of the answer are the vertices of its triangle; the reals are their three weights, the
/// point and its distance.
[[clang::export_name("closest_point")]] std::size_t closest_point(double x, double y, double z, const void* corners,
                                                                  std::size_t corner_count, bool signed_corners,
                                                                  const void* offsets, std::size_t offset_count,
                                                                  bool signed_offsets) {
  workspace.use_faces(view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets),
                      hash_faces(corners, corner_count, offsets, offset_count));
  const SurfacePoint found = workspace.surface().closest_point({x, y, z});
  answer.ids.assign(found.vertices.begin(), found.vertices.end());
  answer.reals.assign(found.weights.begin(), found.weights.end());
  answer.reals.insert(answer.reals.end(), found.point.begin(), found.point.end());
  answer.reals.push_back(found.distance);
  return found.face;
}

}  // extern "C"

}  // namespace meshhood::wasm
