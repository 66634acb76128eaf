// SPDX-License-Identifier: MIT
// The point of the surface nearest to a point in space.
#include <cstddef>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "face_hash.h"
#include "workspace.h"

namespace meshhood::wasm {

extern "C" {

/// See `append_point`.
[[clang::export_name("closest_point")]] void closest_point(double x, double y, double z, const void* corners,
                                                           std::size_t corner_count, bool signed_corners,
                                                           const void* offsets, std::size_t offset_count,
                                                           bool signed_offsets) {
  workspace.use_faces(view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets),
                      hash_faces(corners, corner_count, offsets, offset_count));
  answer = {};
  append_point(workspace.surface().closest_point({x, y, z}));
}

}  // extern "C"

}  // namespace meshhood::wasm
