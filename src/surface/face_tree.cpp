// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/kd_order.h"
#include "base/vector.h"
#include "shared/parallel.h"
#include "simd/node_group.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns the faces that have triangles, at the middles of their boxes.
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

namespace {

// More than the rounding of an angle, and of a cone in single precision.
constexpr double kSlack = 0x1p-20;

// The squares of a shorter vector vanish, and with them its direction.
constexpr double kShortest = 0x1p-480;

/// Normals at most `angle` away from a unit vector; by default none.
struct Bundle {
  Point axis{0, 0, 0};
  double angle = -1;
};

Bundle bundle_of(const Point& area) {
  const double size = length(area);
  if (size >= kShortest) return {(1 / size) * area, 0};
  const bool has_no_normal = area.x == 0 && area.y == 0 && area.z == 0;
  return {{0, 0, 0}, has_no_normal ? -1 : std::numbers::pi};
}

/// If the axes cancel out, one of them is at least 90 degrees away from what is left.
Bundle around(std::span<const Bundle> parts) {
  Bundle all;
  for (const Bundle& part : parts) all.axis = all.axis + part.axis;
  all.axis = (1 / std::max(length(all.axis), kSlack)) * all.axis;
  for (const Bundle& part : parts) {
    if (part.angle < 0) continue;
    const double apart = std::acos(std::clamp(dot(all.axis, part.axis), -1.0, 1.0));
    all.angle = std::max(all.angle, apart + part.angle + kSlack);
  }
  return all;
}

template <class BundleOf>
std::vector<Bundle> in_groups(std::size_t count, BundleOf&& bundle_of_part) {
  std::vector<Bundle> groups;
  groups.reserve((count + kFanOut - 1) / kFanOut);
  for (std::size_t first = 0; first < count; first += kFanOut) {
    std::array<Bundle, kFanOut> parts;
    for (std::size_t i = first; i < std::min(first + kFanOut, count); ++i) parts[i - first] = bundle_of_part(i);
    groups.push_back(around(parts));
  }
  return groups;
}

NormalCone cone_of(const Bundle& normals) {
  if (normals.angle < 0) return {};
  const double left = std::acos(kOpposite) - normals.angle;
  if (left <= 0) return {0, 0, 0, 1};  // may be opposite to any normal
  return {static_cast<float>(normals.axis.x), static_cast<float>(normals.axis.y), static_cast<float>(normals.axis.z),
          static_cast<float>(std::cos(left) + kSlack)};
}

}  // namespace

NormalCones::NormalCones(const IndexView& index, const FaceTree& tree) {
  BoundingBox box;  // in double, because boxes of the tree are rounded to floats of the frame
  for (const Triangle& triangle : tree.triangles()) {
    for (const Point& corner : corners_of(index, triangle.corners)) box.add(corner);
  }
  diagonal_ = length(index.frame.scale * (box.high - box.low));
  std::vector<Bundle> groups = in_groups(
      tree.triangles().size(), [&](std::size_t i) { return bundle_of(doubled_area(index, tree.triangles()[i])); });
  for (;;) {
    std::ranges::transform(groups, levels_.emplace_back(groups.size()).begin(), cone_of);
    if (groups.size() == 1) return;
    groups = in_groups(groups.size(), [&](std::size_t i) { return groups[i]; });
  }
}

std::size_t NormalCones::bytes() const {
  std::size_t bytes = 0;
  for (const std::vector<NormalCone>& level : levels_) bytes += level.size() * sizeof(NormalCone);
  return bytes;
}

}  // namespace meshhood::inline v0_1
