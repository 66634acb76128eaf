// SPDX-License-Identifier: MIT
#include "exact/stored_faces.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "meshhood/error.h"

namespace meshhood::inline v0_1 {
namespace {

bool are_all_triangles(const FacesView& faces) {
  if (faces.are_triangles()) return true;
  for (std::size_t i = 0; i < faces.offsets().size(); ++i) {
    if (faces.offsets()[i] != 3 * i) return false;
  }
  return true;
}

void check_offsets(std::size_t corners) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (corners <= kMost) return;
  raise(ErrorCode::TooLarge, std::to_string(corners) + " corners of faces, but the limit is " + std::to_string(kMost) +
                                 " unless all are triangles");
}

}  // namespace

FaceArrays make_face_arrays(const FacesView& faces) {
  FaceArrays arrays;
  arrays.corners.reserve(faces.corner_count());
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    arrays.corners.insert(arrays.corners.end(), corners.begin(), corners.end());
  });
  if (are_all_triangles(faces)) return arrays;
  check_offsets(faces.corner_count());
  arrays.offsets.reserve(faces.offsets().size());
  for (std::size_t i = 0; i < faces.offsets().size(); ++i) {
    arrays.offsets.push_back(static_cast<std::uint32_t>(faces.offsets()[i]));
  }
  return arrays;
}

}  // namespace meshhood::inline v0_1
