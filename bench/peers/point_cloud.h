// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <nanoflann.hpp>

#include "meshhood/mesh.h"

namespace meshhood::bench {

/// Positions in the interface that nanoflann requires.
struct PointCloud {
  std::vector<float> xyz;

  explicit PointCloud(const PositionsView& positions) {
    positions.visit([&](const auto& strided) {
      const auto given = strided.packed();
      xyz.resize(given.size());
      std::transform(given.begin(), given.end(), xyz.begin(), [](auto x) { return static_cast<float>(x); });
    });
  }
  // NOLINTBEGIN(readability-identifier-naming): nanoflann's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return xyz.size() / 3; }
  [[nodiscard]] float kdtree_get_pt(std::size_t v, std::size_t axis) const { return xyz[3 * v + axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  // NOLINTEND(readability-identifier-naming)
};

/// A kd-tree over the vertices, without the mesh.
using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>, PointCloud, 3, VertexId>;

}  // namespace meshhood::bench
