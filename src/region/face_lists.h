// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood {

/// The corners of each face, and the faces of each vertex.
class FaceLists {
 public:
  /// The mesh must be valid.
  explicit FaceLists(const MeshView& mesh);

  /// #F.
  [[nodiscard]] std::size_t size() const { return corner_begin_.size() - 1; }

  [[nodiscard]] std::span<const VertexId> corners(std::size_t face) const {
    return std::span(corners_).subspan(corner_begin_[face], corner_begin_[face + 1] - corner_begin_[face]);
  }

  /// The faces that have the vertex as a corner, ascending; twice if it is two corners of one.
  [[nodiscard]] std::span<const std::size_t> faces(VertexId v) const {
    return std::span(faces_).subspan(face_begin_[v], face_begin_[v + 1] - face_begin_[v]);
  }

 private:
  std::vector<std::uint64_t> corner_begin_;
  std::vector<VertexId> corners_;
  std::vector<std::uint64_t> face_begin_;
  std::vector<std::size_t> faces_;
};

}  // namespace meshhood
