// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace meshhood::inline v0_1 {

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
};

/// Eight boxes side by side, in the frame.
struct alignas(64) BoxGroup {
  using Row = Group::Row;
  struct Corners {
    Row x;
    Row y;
    Row z;
  };
  Corners low;
  Corners high;
};

/// The exit of a ray from a box counts as this much later, which covers the rounding of entries and exits.
inline constexpr float kExitSlack = 1 + 0x1p-20F;

/// A ray in the frame. Along each axis it comes to the walls of a box at `(low wall - low) * inverse` and
/// `(high wall - high) * inverse`; the smaller one is the entry.
struct BoxRay {
  struct Axis {
    float low;   // where the ray begins, plus the error of positions, so that the box grows by it
    float high;  // the same, minus the error
    float inverse;
  };
  Axis x;
  Axis y;
  Axis z;
};

/// The relation of the nodes of a group to a ball, one bit a node. A node with neither bit is outside the ball.
struct GroupContainment {
  std::uint8_t inside;
  std::uint8_t intersecting;
};

}  // namespace meshhood::inline v0_1
