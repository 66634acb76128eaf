// SPDX-License-Identifier: MIT
#include "patch/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/vector.h"
#include "surface/face_triangles.h"

namespace meshhood {
namespace {

/// The sums over the triangles `begin .. end - 1`, and their box. Corners are seen from the center of the sphere, so
/// that the moment is as accurate far from the origin.
Cluster add_up(const IndexView& index, const Triangles& triangles, TriangleId begin, TriangleId end) {
  BoundingBox box;
  for (TriangleId t = begin; t < end; ++t) {
    for (const Point& corner : corners_of(index, triangles.corners[t])) box.add(corner);
  }
  Cluster sums{box, 0, 0, {0, 0, 0}, 0, 0, 0, 0, false};
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

}  // namespace

Clusters::Clusters(const IndexView& index, const Triangles& triangles) : of_triangle(triangles.size()) {
  const std::size_t count = triangles.first_of_cluster.size() - 1;
  for (ClusterId cluster = 0; cluster < count; ++cluster) {
    const TriangleId end = triangles.first_of_cluster[cluster + std::size_t{1}];
    for (TriangleId t = triangles.first_of_cluster[cluster]; t < end; ++t) of_triangle[t] = cluster;
  }
  const auto set_first = [&] {
    clusters.back().first_link = static_cast<std::uint32_t>(links.size());
    clusters.back().first_hub = static_cast<std::uint32_t>(hubs.size());
    clusters.back().first_corner = static_cast<std::uint32_t>(corners.size());
  };
  for (ClusterId cluster = 0; cluster < count; ++cluster) {
    const TriangleId end = triangles.first_of_cluster[cluster + std::size_t{1}];
    clusters.push_back(add_up(index, triangles, triangles.first_of_cluster[cluster], end));
    set_first();
    link(triangles, cluster);
  }
  clusters.push_back({});
  set_first();
  links.push_back({0, static_cast<std::uint32_t>(linked.size())});
  list_by_leaf(index);
  boxes.build(count, [&](std::size_t i) {
    const BoundingBox& box = clusters[i].box;
    return BoundingBox{index.frame.to_frame(box.low), index.frame.to_frame(box.high)};
  });
}

void Clusters::list_by_leaf(const IndexView& index) {
  const auto for_each_leaf = [&](auto&& f) {
    for (ClusterId cluster = 0; cluster < size(); ++cluster) {
      std::optional<LeafId> last;
      for (const std::uint32_t place : corners_of(cluster)) {
        const LeafId leaf = leaf_of(index.slot_at(place));
        if (leaf != last) f(cluster, leaf);
        last = leaf;
      }
    }
  };
  first_of_leaf.assign(index.leaf_count() + 2, 0);
  for_each_leaf([&](ClusterId, LeafId leaf) { ++first_of_leaf[leaf + std::size_t{2}]; });
  for (std::size_t i = 2; i < first_of_leaf.size(); ++i) first_of_leaf[i] += first_of_leaf[i - 1];
  of_leaf.resize(first_of_leaf.back());
  for_each_leaf([&](ClusterId cluster, LeafId leaf) { of_leaf[first_of_leaf[leaf + std::size_t{1}]++] = cluster; });
  first_of_leaf.pop_back();
}

/// The corners of a cluster, and the triangles of other clusters there.
void Clusters::link(const Triangles& triangles, ClusterId cluster) {
  const auto first = static_cast<std::ptrdiff_t>(linked.size());
  const TriangleId begin = triangles.first_of_cluster[cluster];
  const TriangleId end = triangles.first_of_cluster[cluster + std::size_t{1}];
  const auto first_corner = static_cast<std::ptrdiff_t>(corners.size());
  for (TriangleId t = begin; t < end; ++t) {
    corners.insert(corners.end(), triangles.corners[t].begin(), triangles.corners[t].end());
  }
  std::sort(corners.begin() + first_corner, corners.end());
  corners.erase(std::unique(corners.begin() + first_corner, corners.end()), corners.end());
  for (const std::uint32_t place : std::span(corners).subspan(static_cast<std::size_t>(first_corner))) {
    if (triangles.fan(place).size() > kMostLinked) {
      hubs.push_back(place);
      continue;
    }
    for (const TriangleId t : triangles.fan(place)) {
      if (t < begin || t >= end) linked.push_back(t);
    }
  }
  std::sort(linked.begin() + first, linked.end());
  linked.erase(std::unique(linked.begin() + first, linked.end()), linked.end());
  for (auto i = static_cast<std::size_t>(first); i < linked.size(); ++i) {
    const ClusterId other = of_triangle[linked[i]];
    if (i > static_cast<std::size_t>(first) && links.back().cluster == other) continue;
    links.push_back({other, static_cast<std::uint32_t>(i)});
  }
}

std::size_t Clusters::bytes() const {
  const auto bytes_of = [](const auto& array) { return array.size() * sizeof(array[0]); };
  return bytes_of(clusters) + bytes_of(links) + bytes_of(linked) + bytes_of(hubs) + bytes_of(corners) +
         bytes_of(of_triangle) + bytes_of(first_of_leaf) + bytes_of(of_leaf) + boxes.bytes();
}

}  // namespace meshhood
