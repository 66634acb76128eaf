// SPDX-License-Identifier: MIT
#include "patch/meshlets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "base/vector.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {
namespace {

/// The sums over the triangles `begin .. end - 1`, and their box. Corners are seen from the center of the sphere, so
/// that the moment is as accurate far from the origin.
Meshlet add_up(const IndexView& index, const Triangles& triangles, TriangleId begin, TriangleId end) {
  BoundingBox box;
  for (TriangleId t = begin; t < end; ++t) {
    for (const Point& corner : corners_of(index, triangles.corners[t])) box.add(corner);
  }
  Meshlet sums{box, 0, 0, {0, 0, 0}, 0, 0, false};
  for (TriangleId t = begin; t < end; ++t) {
    std::array<Point, 3> corners = corners_of(index, triangles.corners[t]);
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = index.frame.scale * (corners[i] - sums.center());
      sums.radius = std::max(sums.radius, length(corners[i]));
      sums.has_border |= triangles.is_border(t, static_cast<unsigned>(i));
    }
    const Point area = 0.5 * doubled_vector_area(corners[0], corners[1], corners[2]);
    sums.area += length(area);
    sums.vector_area = sums.vector_area + area;
    sums.moment += dot(area, corners[0]);
  }
  return sums;
}

/// The same index, whose answers have the ignored vertices, too.
Index without_ignored(const Index& given) {
  if (IndexAccess::view(given).ignored.empty()) return IndexAccess::alias(given);
  auto view = std::make_shared<IndexView>(IndexAccess::view(given));
  view->ignored = {};
  return IndexAccess::make(std::move(view), IndexAccess::share_graph(given));
}

}  // namespace

Meshlets::Meshlets(const IndexView& index, const Triangles& triangles) {
  const std::size_t count = triangles.first_of_meshlet.size() - 1;
  meshlets.reserve(count + 1);
  for (MeshletId meshlet = 0; meshlet < count; ++meshlet) add(index, triangles, meshlet);
  corners.shrink_to_fit();
  meshlets.push_back({});
  meshlets.back().first_corner = static_cast<std::uint32_t>(corners.size());
  list_by_leaf(index);
  boxes.build(count, [&](std::size_t i) {
    const BoundingBox& box = meshlets[i].box;
    return BoundingBox{index.frame.to_frame(box.low), index.frame.to_frame(box.high)};
  });
}

void Meshlets::add(const IndexView& index, const Triangles& triangles, MeshletId meshlet) {
  const TriangleId begin = triangles.first_of_meshlet[meshlet];
  const TriangleId end = triangles.first_of_meshlet[meshlet + std::size_t{1}];
  const auto first = static_cast<std::ptrdiff_t>(corners.size());
  for (TriangleId t = begin; t < end; ++t) {
    corners.insert(corners.end(), triangles.corners[t].begin(), triangles.corners[t].end());
  }
  std::sort(corners.begin() + first, corners.end());
  corners.erase(std::unique(corners.begin() + first, corners.end()), corners.end());
  meshlets.push_back(add_up(index, triangles, begin, end));
  meshlets.back().first_corner = static_cast<std::uint32_t>(first);
}

void Meshlets::list_by_leaf(const IndexView& index) {
  std::vector<std::pair<LeafId, MeshletId>> all;
  for (MeshletId meshlet = 0; meshlet < size(); ++meshlet) {
    for (const std::uint32_t place : corners_of(meshlet)) {
      const std::pair next(leaf_of(index.slot_at(place)), meshlet);
      if (all.empty() || all.back() != next) all.push_back(next);  // places of a leaf follow each other
    }
  }
  std::sort(all.begin(), all.end());
  first_of_leaf.assign(index.leaf_count() + 1, 0);
  of_leaf.reserve(all.size());
  for (const auto& [leaf, meshlet] : all) {
    ++first_of_leaf[leaf + std::size_t{1}];
    of_leaf.push_back(meshlet);
  }
  std::partial_sum(first_of_leaf.begin(), first_of_leaf.end(), first_of_leaf.begin());
}

std::size_t Meshlets::bytes() const {
  const auto bytes_of = [](const auto& array) { return array.size() * sizeof(array[0]); };
  return bytes_of(meshlets) + bytes_of(corners) + bytes_of(first_of_leaf) + bytes_of(of_leaf) + boxes.bytes();
}

PatchState::PatchState(const Index& given, const StoredFaces& all)
    : searched(without_ignored(given)),
      index(&IndexAccess::view(searched)),
      faces(&all),
      triangles(*index, all),
      meshlets(*index, triangles) {}

}  // namespace meshhood::inline v0_1
