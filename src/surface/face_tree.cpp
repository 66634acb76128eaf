// SPDX-License-Identifier: MIT
#include "surface/face_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/vector.h"

namespace meshhood {
namespace {

/// Where a face is.
struct Place {
  std::array<float, 3> center;  // of its box, in the frame
  std::uint32_t face;
  std::uint32_t triangles;
};

/// The axis along which the centers extend the most.
std::size_t widest_axis(std::span<const Place> faces) {
  std::array<float, 3> low = faces.front().center;
  std::array<float, 3> high = low;
  for (const Place& place : faces) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place.center[axis]);
      high[axis] = std::max(high[axis], place.center[axis]);
    }
  }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  }
  return widest;
}

/// Sorts faces, whose triangles are number `begin` to `end - 1`, so that each group of the tree is compact: divides
/// them along the widest axis where the largest group that begins among them begins. Exactly there if all faces have
/// the same number of triangles, and near there otherwise.
void sort_in_space(std::span<Place> faces, std::size_t begin, std::size_t end) {
  const std::size_t last = (end - 1) / kFanOut;
  while (faces.size() > 1 && begin / kFanOut != last) {
    const std::size_t middle = (last & ~(std::bit_floor(begin / kFanOut ^ last) - 1)) * kFanOut;
    const double share = static_cast<double>(middle - begin) / static_cast<double>(end - begin);
    const auto count = static_cast<std::size_t>(share * static_cast<double>(faces.size()) + 0.5);
    const std::span<Place> before = faces.first(std::clamp<std::size_t>(count, 1, faces.size() - 1));
    const std::size_t axis = widest_axis(faces);
    std::ranges::nth_element(faces, before.end(), {}, [axis](const Place& place) { return place.center[axis]; });
    std::size_t between = begin;
    for (const Place& place : before) between += place.triangles;
    sort_in_space(before, begin, between);
    faces = faces.subspan(before.size());
    begin = between;
  }
}

}  // namespace

FaceTree::FaceTree(const IndexView& index, const StoredFaces& faces) : first_(faces.size()) {
  std::vector<Place> places;
  std::size_t count = 0;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const std::size_t triangles = triangle_count(faces[face].size());
    if (triangles == 0) continue;
    BoundingBox box;
    for (const VertexId v : faces[face]) box.add(index.in_frame(index.place(v)));
    const Point center = 0.5 * (box.low + box.high);
    places.push_back({{static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)},
                      static_cast<std::uint32_t>(face),
                      static_cast<std::uint32_t>(triangles)});
    count += triangles;
  }
  check_triangle_count(count);
  sort_in_space(places, 0, count);
  triangles_.resize(count);
  Triangulator triangulator(index);
  std::uint32_t next = 0;
  for (const Place& place : places) {
    first_[place.face] = next;
    triangulator.run(place.face, faces[place.face], &triangles_[next]);
    next += place.triangles;
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
