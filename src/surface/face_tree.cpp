// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <variant>

#include "meshhood/error.h"

#include "base/triangulate.h"
#include "base/vector.h"

namespace meshhood {
namespace {

/// The least place of a corner.
std::uint32_t first_place(const IndexView& index, std::span<const VertexId> corners) {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  for (const VertexId v : corners) first = std::min(first, index.place(v));
  return first;
}

std::size_t triangle_count(std::span<const VertexId> corners) { return corners.size() < 3 ? 0 : corners.size() - 2; }

/// Divides faces of an index into triangles.
class Triangulator {
 public:
  explicit Triangulator(const IndexView& index) : index_(&index) {}

  /// Writes `triangle_count(corners)` triangles.
  void run(std::uint32_t face, std::span<const VertexId> corners, Triangle* out) {
    points_.clear();
    for (const VertexId v : corners) points_.push_back(index_->frame.scale * position(v));
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

 private:
  [[nodiscard]] Point position(VertexId v) const {
    return std::visit([&](auto xyz) { return point(xyz, index_->place(v)); }, index_->positions);
  }

  const IndexView* index_;
  std::vector<Point> points_;
  Triangulation triangles_;
};

/// Counting sort by the first corner of each face.
std::vector<Triangle> sorted_triangles(const IndexView& index, const StoredFaces& faces) {
  std::vector<std::size_t> next(index.vertex_count() + 1, 0);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (const std::size_t count = triangle_count(faces[face])) {
      next[first_place(index, faces[face]) + std::size_t{1}] += count;
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Triangle> triangles(next.back());
  Triangulator triangulator(index);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::size_t count = triangle_count(faces[face]);
    if (count == 0) continue;
    std::size_t& begin = next[first_place(index, faces[face])];
    triangulator.run(static_cast<std::uint32_t>(face), faces[face], &triangles[begin]);
    begin += count;
  }
  return triangles;
}

}  // namespace

FaceTree::FaceTree(const IndexView& index, const StoredFaces& faces) : triangles_(sorted_triangles(index, faces)) {
  if (triangles_.empty()) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
  boxes_.build(triangles_.size(), [&](std::size_t i) { return box_of(index, i); });
}

void FaceTree::renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed) {
  const auto key = [&](std::uint32_t face) { return std::pair(first_place(index, faces[face]), face); };
  std::vector<std::size_t> moved;
  Triangulator triangulator(index);
  for (const std::uint32_t face : changed) {
    const std::size_t count = triangle_count(faces[face]);
    if (count == 0) continue;
    const auto found = std::ranges::lower_bound(triangles_, key(face), {},
                                                [&](const Triangle& triangle) { return key(triangle.face); });
    triangulator.run(face, faces[face], &*found);
    const auto first = static_cast<std::size_t>(found - triangles_.begin());
    for (std::size_t i = 0; i < count; ++i) moved.push_back(first + i);
  }
  boxes_.renew(std::move(moved), [&](std::size_t i) { return box_of(index, i); });
}

BoundingBox FaceTree::box_of(const IndexView& index, std::size_t i) const {
  BoundingBox box;
  for (const std::uint32_t place : triangles_[i].corners) box.add(index.in_frame(place));
  return box;
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

}  // namespace meshhood
