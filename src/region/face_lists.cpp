// SPDX-License-Identifier: MIT
#include "region/face_lists.h"

#include <numeric>

namespace meshhood {

FaceLists::FaceLists(const MeshView& mesh) {
  corner_begin_.reserve(mesh.faces.size() + 1);
  corners_.reserve(mesh.faces.corner_count());
  corner_begin_.push_back(0);
  face_begin_.assign(mesh.positions.size() + 1, 0);
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    for (const VertexId corner : corners) ++face_begin_[corner];
    corner_begin_.push_back(corners_.size());
  });
  // Each number stands at the end of its list and moves to the beginning as the list fills, from the last face on.
  std::inclusive_scan(face_begin_.begin(), face_begin_.end(), face_begin_.begin());
  faces_.resize(corners_.size());
  for (std::size_t face = size(); face-- > 0;) {
    for (const VertexId corner : corners(face)) faces_[--face_begin_[corner]] = face;
  }
}

}  // namespace meshhood
