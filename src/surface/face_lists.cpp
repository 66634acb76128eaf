// SPDX-License-Identifier: MIT
#include "surface/face_lists.h"

#include <numeric>

namespace meshhood {

FaceLists::FaceLists(const StoredFaces& faces, std::size_t vertices)
    : begin_(vertices + 1), faces_(faces.corners.size()) {
  for (const VertexId corner : faces.corners) ++begin_[corner];
  // Each number stands at the end of its list and moves to the beginning as the list fills, from the last face on.
  std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
  for (std::size_t face = faces.size(); face-- > 0;) {
    for (const VertexId corner : faces[face]) faces_[--begin_[corner]] = static_cast<std::uint32_t>(face);
  }
}

}  // namespace meshhood
