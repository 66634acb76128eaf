// SPDX-License-Identifier: MIT
#include "parts/corner_positions.h"

#include <algorithm>

namespace meshhood::parts {

CornerPositions::CornerPositions(ChunkedMesh& mesh, const FaceChunk& faces) {
  if (faces.corners.empty()) return;
  const auto [least, most] = std::minmax_element(faces.corners.begin(), faces.corners.end());
  if (*most - *least < faces.corners.size()) {
    first_ = *least;
    positions_.resize(static_cast<std::size_t>(*most - *least + 1));
    mesh.read_positions(first_, positions_);
  } else {
    read_sparse(mesh, faces);
  }
}

const Point& CornerPositions::operator[](std::uint64_t id) const {
  if (ids_.empty()) return positions_[static_cast<std::size_t>(id - first_)];
  return positions_[static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin())];
}

void CornerPositions::read_sparse(ChunkedMesh& mesh, const FaceChunk& faces) {
  // A read of this many vertices costs about as much as another call.
  constexpr std::uint64_t kWindow = 4096;
  ids_ = faces.corners;
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  positions_.reserve(ids_.size());
  std::vector<Point> window;
  for (std::size_t i = 0; i < ids_.size();) {
    const std::uint64_t first = ids_[i];
    const std::size_t begin = i;
    while (i < ids_.size() && ids_[i] - first < kWindow) ++i;
    window.resize(static_cast<std::size_t>(ids_[i - 1] - first + 1));
    mesh.read_positions(first, window);
    for (std::size_t k = begin; k < i; ++k) positions_.push_back(window[static_cast<std::size_t>(ids_[k] - first)]);
  }
}

}  // namespace meshhood::parts
