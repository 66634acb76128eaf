// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <utility>

#include "base/kd_order.h"
#include "base/vector.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

/// The faces that have triangles, at the middles of their boxes.
std::vector<KdPoint> centers_of(const IndexView& index, const StoredFaces& faces) {
  std::vector<KdPoint> centers;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (triangle_count(faces[face].size()) == 0) continue;
    BoundingBox box;
    for (const VertexId v : faces[face]) box.add(index.in_frame(index.place(v)));
    centers.push_back(kd_point(0.5 * (box.low + box.high), face));
  }
  return centers;
}

}  // namespace

FaceTree::FaceTree(const IndexView& index, const StoredFaces& faces, TaskContext& task) : first_(faces.size()) {
  std::vector<KdPoint> centers = centers_of(index, faces);
  std::size_t count = 0;
  for (const KdPoint& center : centers) count += triangle_count(faces[center.id].size());
  check_triangle_count(count);
  // So many faces have about as many triangles as a group of boxes.
  const std::size_t faces_of_group = std::max<std::size_t>(kFanOut * centers.size() / count, 1);
  kd_order(centers, faces_of_group, task, KdCut::Power);
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

}  // namespace meshhood::inline v0_1
