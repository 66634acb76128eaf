// SPDX-License-Identifier: MIT
#include "surface/face_triangles.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <variant>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

/// The least place of a corner.
std::uint32_t first_place(const IndexView& index, std::span<const VertexId> corners) {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  for (const VertexId v : corners) first = std::min(first, index.place(v));
  return first;
}

}  // namespace

void Triangulator::run(std::uint32_t face, std::span<const VertexId> corners, Triangle* out) {
  points_.clear();
  for (const VertexId v : corners) points_.push_back(index_->frame.scale * index_->position(index_->place(v)));
  triangulate(points_, triangles_);
  for (const auto& [a, b, c] : triangles_) {
    const auto is_diagonal = [&](std::size_t i, std::size_t j) {
      return static_cast<unsigned>((i + 1) % corners.size() != j && (j + 1) % corners.size() != i);
    };
    *out++ = {{index_->place(corners[a]), index_->place(corners[b]), index_->place(corners[c])},
              face,
              is_diagonal(a, b) | is_diagonal(b, c) << 1U | is_diagonal(c, a) << 2U};
  }
}

// Counting sort by the first corner of each face.
std::vector<Triangle> triangles_in_index_order(const IndexView& index, const StoredFaces& faces) {
  std::vector<std::size_t> next(index.vertex_count() + 1, 0);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (const std::size_t count = triangle_count(faces[face].size())) {
      next[first_place(index, faces[face]) + std::size_t{1}] += count;
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  check_triangle_count(next.back());
  std::vector<Triangle> triangles(next.back());
  Triangulator triangulator(index);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::size_t count = triangle_count(faces[face].size());
    if (count == 0) continue;
    std::size_t& begin = next[first_place(index, faces[face])];
    triangulator.run(static_cast<std::uint32_t>(face), faces[face], &triangles[begin]);
    begin += count;
  }
  return triangles;
}

std::array<Point, 3> corners_of(const IndexView& index, const std::array<std::uint32_t, 3>& places) {
  return std::visit(
      [&](auto xyz) { return std::array{point(xyz, places[0]), point(xyz, places[1]), point(xyz, places[2])}; },
      index.positions);
}

SurfacePoint surface_point(const IndexView& index, const StoredFaces& faces, std::size_t face,
                           const std::array<std::uint32_t, 3>& places, const TrianglePoint& found) {
  const std::span<const VertexId> all = faces[face];
  SurfacePoint result{face, {}, {}, found.barycentric, {found.point.x, found.point.y, found.point.z}, found.distance};
  for (std::size_t i = 0; i < 3; ++i) {
    result.vertices[i] = index.id(places[i]);
    result.corners[i] = static_cast<std::size_t>(std::ranges::find(all, result.vertices[i]) - all.begin());
  }
  return result;
}

}  // namespace meshhood::inline v0_1
