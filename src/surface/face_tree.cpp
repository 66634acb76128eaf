// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "meshhood/error.h"

namespace meshhood {
namespace {

std::uint32_t first_corner(const Triangle& triangle) { return std::ranges::min(triangle.corners); }

/// Calls `f` for the triangles of a face.
template <class F>
void for_each_triangle(const IndexView& index, const StoredFaces& faces, std::size_t face, F&& f) {
  const std::span<const VertexId> all = faces[face];
  for (std::size_t second = 1; second + 1 < all.size(); ++second) {
    f(Triangle{{index.place(all[0]), index.place(all[second]), index.place(all[second + 1])},
               static_cast<std::uint32_t>(face),
               static_cast<std::uint32_t>(second)});
  }
}

/// Counting sort by the first corner.
std::vector<Triangle> sorted_triangles(const IndexView& index, const StoredFaces& faces) {
  const auto for_each = [&](auto&& f) {
    for (std::size_t face = 0; face < faces.size(); ++face) for_each_triangle(index, faces, face, f);
  };
  std::vector<std::size_t> next(index.vertex_count() + 1, 0);
  for_each([&](const Triangle& triangle) { ++next[first_corner(triangle) + std::size_t{1}]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Triangle> triangles(next.back());
  for_each([&](const Triangle& triangle) { triangles[next[first_corner(triangle)]++] = triangle; });
  return triangles;
}

}  // namespace

FaceTree::FaceTree(const IndexView& index, const StoredFaces& faces) : triangles_(sorted_triangles(index, faces)) {
  if (triangles_.empty()) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
  boxes_.build(triangles_.size(), [&](std::size_t i) { return box_of(index, i); });
}

void FaceTree::renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed) {
  const auto key = [](const Triangle& triangle) {
    return std::tuple(first_corner(triangle), triangle.face, triangle.second);
  };
  std::vector<std::size_t> moved;
  for (const std::uint32_t face : changed) {
    for_each_triangle(index, faces, face, [&](const Triangle& triangle) {
      const auto found = std::ranges::lower_bound(triangles_, key(triangle), {}, key);
      moved.push_back(static_cast<std::size_t>(found - triangles_.begin()));
    });
  }
  boxes_.renew(std::move(moved), [&](std::size_t i) { return box_of(index, i); });
}

BoundingBox FaceTree::box_of(const IndexView& index, std::size_t i) const {
  BoundingBox box;
  for (const std::uint32_t place : triangles_[i].corners) box.add(index.in_frame(place));
  return box;
}

}  // namespace meshhood
