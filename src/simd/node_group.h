// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace meshhood {

inline constexpr unsigned kFanOut = 8;

/// Eight nodes of the tree side by side, so that one kernel call compares all of them with a ball. The places of nodes
/// that do not exist hold spheres far outside the frame.
struct alignas(64) Group {
  using Row = std::array<float, kFanOut>;
  // Bounding spheres, in the frame.
  Row x;
  Row y;
  Row z;
  Row radius;
  // Minimum regions: a query point at `p` from the center of the sphere is in the region where
  // |p| <= offset + |p . slope|.
  Row slope_x;
  Row slope_y;
  Row slope_z;
  Row offset;
};

/// The relation of the nodes of a group to a ball, one bit a node. A node with neither of the first two bits is outside
/// the ball.
struct GroupContainment {
  std::uint8_t inside;
  std::uint8_t intersecting;
  std::uint8_t may_have_minimum;  // the ball's center may lie in the minimum region of the node
};

/// The square of a distance is multiplied by this before it is compared with the square of the extent of a minimum
/// region. It covers the rounding of the comparison in single precision.
inline constexpr float kRegionMargin = 1 - 0x1p-18F;

}  // namespace meshhood
