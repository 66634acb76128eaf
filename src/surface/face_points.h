// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/mesh.h"
#include "meshhood/start.h"

#include "exact/stored_faces.h"

namespace meshhood::inline v0_1 {

/// A checked copy of the rows of a call about points of faces: later changes by the caller have no effect.
class FacePoints {
 public:
  /// mesh  all faces.
  /// Throws Error{InvalidOption}, naming the row, and if the numbers of rows differ.
  FacePoints(const StoredFaces& mesh, const IndicesView& faces, std::span<const SpacePoint> points);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] std::size_t face(std::size_t row) const { return faces_[row]; }
  [[nodiscard]] const SpacePoint& point(std::size_t row) const { return points_[row]; }

  /// Returns a corner of each face, so that rows can be in index order; 0 for a face without corners.
  [[nodiscard]] const std::vector<VertexId>& corners() const { return corners_; }

 private:
  std::vector<std::size_t> faces_;
  std::vector<SpacePoint> points_;
  std::vector<VertexId> corners_;
};

}  // namespace meshhood::inline v0_1
