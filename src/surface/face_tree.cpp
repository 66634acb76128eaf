// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <utility>

#include "base/vector.h"
#include "exact/build/kd_order.h"
#include "shared/parallel.h"

namespace meshhood {

FaceTree::FaceTree(const IndexView& index, const StoredFaces& faces, TaskContext& task) : first_(faces.size()) {
  std::vector<KdPoint> centers;
  std::size_t count = 0;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::size_t triangles = triangle_count(faces[face].size());
    if (triangles == 0) continue;
    BoundingBox box;
    for (const VertexId v : faces[face]) box.add(index.in_frame(index.place(v)));
    const Point center = 0.5 * (box.low + box.high);
    centers.push_back({{static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)},
                       static_cast<std::uint32_t>(face)});
    count += triangles;
  }
  check_triangle_count(count);
  kd_order(centers, std::max<std::size_t>(kFanOut * centers.size() / count, 1), task, KdCut::Power);
  triangles_.resize(count);
  Triangulator triangulator(index);
  std::size_t next = 0;
  for (const auto& [at, face] : centers) {
    first_[face] = static_cast<std::uint32_t>(next);
    triangulator.run(face, faces[face], &triangles_[next]);
    next += triangle_count(faces[face].size());
  }
  boxes_.build(triangles_.size(), [&](std::size_t i) { return box_of(index, i); });
}

void FaceTree::renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed) {
  std::vector<std::size_t> moved;
  Triangulator triangulator(index);
  for (const std::uint32_t face : changed) {
    const std::size_t count = triangle_count(faces[face].size());
    if (count == 0) continue;
    triangulator.run(face, faces[face], &triangles_[first_[face]]);
    for (std::size_t i = 0; i < count; ++i) moved.push_back(first_[face] + i);
  }
  boxes_.renew(std::move(moved), [&](std::size_t i) { return box_of(index, i); });
}

BoundingBox FaceTree::box_of(const IndexView& index, std::size_t i) const {
  BoundingBox box;
  for (const std::uint32_t place : triangles_[i].corners) box.add(index.in_frame(place));
  return box;
}

}  // namespace meshhood
