// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "meshhood/vertex_id.h"

#include "exact/stored_faces.h"

namespace meshhood {

/// The faces of each vertex.
class FaceLists {
 public:
  FaceLists(const StoredFaces& faces, std::size_t vertices);

  /// The faces that have the vertex as a corner, ascending; twice if it is two corners of one.
  [[nodiscard]] std::span<const std::uint32_t> operator[](VertexId v) const {
    return std::span(faces_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

  [[nodiscard]] std::size_t bytes() const {
    return begin_.size() * sizeof(begin_.front()) + faces_.size() * sizeof(faces_.front());
  }

 private:
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> faces_;
};

inline FaceLists::FaceLists(const StoredFaces& faces, std::size_t vertices)
    : begin_(vertices + 1), faces_(faces.corners.size()) {
  for (const VertexId corner : faces.corners) ++begin_[corner];
  // Each number stands at the end of its list and moves to the beginning as the list fills, from the last face on.
  std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
  for (std::size_t face = faces.size(); face-- > 0;) {
    for (const VertexId corner : faces[face]) faces_[--begin_[corner]] = static_cast<std::uint32_t>(face);
  }
}

}  // namespace meshhood
