// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "exact/verify.h"

namespace meshhood::inline v0_1::file {
namespace {

void verify_corners(std::span<const VertexId> corners, std::size_t vertices, const SectionReader& file) {
  for (const VertexId& corner : corners) {
    if (corner < vertices) continue;
    file.refuse(&corner,
                "vertex " + std::to_string(corner) + ", but there are " + std::to_string(vertices) + " vertices");
  }
}

void verify_offsets(std::span<const std::uint32_t> offsets, std::size_t corners, const SectionReader& file) {
  if (offsets.front() != 0) file.refuse(&offsets.front(), "face 0 does not begin at corner 0");
  bool are_triangles = true;
  for (std::size_t face = 0; face + 1 < offsets.size(); ++face) {
    const std::uint32_t begin = offsets[face];
    const std::uint32_t end = offsets[face + 1];
    if (begin > end) {
      file.refuse(&offsets[face + 1], "face " + std::to_string(face) + " ends at corner " + std::to_string(end) +
                                          ", before it begins at " + std::to_string(begin));
    }
    are_triangles = are_triangles && end - begin == 3;
  }
  if (offsets.back() != corners) {
    file.refuse(&offsets.back(),
                "the faces have " + std::to_string(offsets.back()) + " corners, expected " + std::to_string(corners));
  }
  if (are_triangles) file.refuse(&offsets.front(), "all faces are triangles, expected no offsets");
}

}  // namespace

void verify_faces(const IndexView& index, const SectionReader& file) {
  if (!index.faces) return;
  verify_corners(index.faces->corners, index.vertex_count(), file);
  if (!index.faces->offsets.empty()) verify_offsets(index.faces->offsets, index.faces->corners.size(), file);
}

}  // namespace meshhood::inline v0_1::file
