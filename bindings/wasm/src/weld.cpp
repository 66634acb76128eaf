// SPDX-License-Identifier: MIT
// Welding: JavaScript copies the answer, and drops the instance.
#include "io/weld.h"

#include <cstddef>

#include "answer.h"
#include "arguments.h"

namespace meshhood::wasm {

extern "C" {

/// The ids of the answer are those that the vertices get, the counts the new corners. The faces keep their offsets.
[[clang::export_name("weld")]] void weld(const void* xyz, std::size_t scalars, bool is_double, const void* corners,
                                         std::size_t corner_count, bool signed_corners, const void* offsets,
                                         std::size_t offset_count, bool signed_offsets, double eps) {
  const io::WeldedMesh welded =
      io::weld({view_positions(xyz, scalars, is_double),
                view_faces(corners, corner_count, signed_corners, offsets, offset_count, signed_offsets)},
               eps);
  answer.ids.assign(welded.ids.begin(), welded.ids.end());
  answer.counts.assign(welded.corners.begin(), welded.corners.end());
}

}  // extern "C"

}  // namespace meshhood::wasm
