// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "meshhood/meshhood.h"

namespace meshhood::bench {

/// Random vertices, moved by up to `distance` along each axis; points of the box if it is infinite.
inline std::vector<SpacePoint> random_points(const MeshView& mesh, std::size_t count, double distance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto positions = mesh.positions.visit([](const auto& xyz) {
    std::vector<SpacePoint> all(xyz.size());
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) all[v][axis] = static_cast<double>(xyz(v, axis));
    }
    return all;
  });
  SpacePoint low = positions.front();
  SpacePoint high = positions.front();
  for (const SpacePoint& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  std::vector<SpacePoint> points(count);
  for (SpacePoint& p : points) {
    const SpacePoint& vertex = positions[random() % positions.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis] = distance < std::numeric_limits<double>::infinity()
                    ? vertex[axis] + distance * unit(random)
                    : low[axis] + (high[axis] - low[axis]) * (unit(random) + 1) / 2;
    }
  }
  return points;
}

}  // namespace meshhood::bench
