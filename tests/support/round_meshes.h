// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/test_mesh.h"

namespace meshhood::test {

/// A sphere of radius 1, none of whose sides are along an axis.
[[nodiscard]] inline TestMesh ball(std::size_t rings, std::size_t sectors) {
  TestMesh mesh;
  const auto turn = [](double x, double y, double z) { return std::array{0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z}; };
  const auto add = [&](double x, double y, double z) {
    const auto [a, b, c] = turn(x, z, y);
    return mesh.add_vertex(a, c, b);
  };
  const auto top = add(0, 0, 1);
  std::vector<std::uint32_t> previous(sectors, top);
  for (std::size_t ring = 1; ring <= rings; ++ring) {
    const double height = std::numbers::pi * static_cast<double>(ring) / static_cast<double>(rings);
    std::vector<std::uint32_t> next(sectors, 0);
    for (std::size_t i = 0; i < sectors; ++i) {
      const double around = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sectors);
      next[i] = ring == rings && i > 0
                    ? next[0]
                    : add(std::sin(height) * std::cos(around), std::sin(height) * std::sin(around), std::cos(height));
    }
    for (std::size_t i = 0; i < sectors; ++i) {
      const std::size_t j = (i + 1) % sectors;
      if (ring > 1) mesh.add_face({previous[i], next[i], previous[j]});
      if (ring < rings) mesh.add_face({next[i], next[j], previous[j]});
    }
    previous = next;
  }
  mesh.finish(false);
  return mesh;
}

}  // namespace meshhood::test
