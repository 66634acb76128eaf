// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>

#include "meshhood/mesh.h"

#include "base/distance.h"
#include "exact/layout.h"

/// All that is written for particular processors. Each function does the same on each, bit for bit.
namespace meshhood {

enum class Isa : std::uint8_t { Portable, Avx2, Avx512 };

/// The best that this processor has.
[[nodiscard]] Isa best_isa();

/// What the squared distance of a vertex is compared with, by the radius alone.
struct LeafBounds {
  double squared_radius;  // of the predicate
  // For float positions: a squared distance computed in float is decided by these, or by the predicate in between.
  float surely_inside;   // <=
  float surely_outside;  // >

  explicit LeafBounds(double radius);
};

/// A search ball, prepared for comparing whole leaves.
struct LeafBall : LeafBounds {
  Point centre;
  // The same in float.
  float x;
  float y;
  float z;

  LeafBall(const Point& centre, const LeafBounds& bounds);
};

/// What the distance of a bounding sphere is compared with, in the frame.
struct TreeBounds {
  float outer;  // no vertex farther than this is in the ball
  float inner;  // every vertex not farther is

  TreeBounds(const Frame& frame, double radius);
};

/// A search ball in the frame, prepared for comparing bounding spheres and regions.
struct TreeBall : TreeBounds {
  float x;
  float y;
  float z;

  TreeBall(const FramePoint& centre, const TreeBounds& bounds);
  TreeBall(const Frame& frame, const Point& centre, double radius)
      : TreeBall(frame.round(centre), TreeBounds(frame, radius)) {}
};

/// How the nodes of a group lie to a ball, a bit a node. A node may be neither inside nor intersecting: then it is
/// outside.
struct GroupContainment {
  std::uint8_t inside;
  std::uint8_t intersecting;
  std::uint8_t may_have_minimum;  // the ball's centre stands in the region of the node, or may
};

/// A single node against the ball, as `Kernels::classify` does it.
[[nodiscard]] inline Containment classify(const FrameSphere& sphere, const TreeBall& ball) {
  const float x = ball.x - sphere.x;
  const float y = ball.y - sphere.y;
  const float z = ball.z - sphere.z;
  const float square = (x * x + y * y) + z * z;
  const float far = ball.outer + sphere.radius;
  if (square > far * far) return Containment::Outside;
  const float near = ball.inner - sphere.radius;
  return near > 0 && square < near * near ? Containment::Inside : Containment::Intersecting;
}

struct Nearest {
  double square;  // of the distance, as the predicate has it
  unsigned lane;
};

struct Kernels {
  /// Which of the first `size` vertices of `xyz`, #V by 3, are in the ball; `size` <= 32. Reads as far as 32.
  LaneMask (*within_float)(const float* xyz, std::size_t size, const LeafBall& ball);
  LaneMask (*within_double)(const double* xyz, std::size_t size, const LeafBall& ball);

  /// Of the vertices `lanes` of `xyz`, at least one, that nearest to the centre; the first of several. Reads as far as
  /// 32.
  Nearest (*nearest_float)(const float* xyz, LaneMask lanes, const LeafBall& ball);
  Nearest (*nearest_double)(const double* xyz, LaneMask lanes, const LeafBall& ball);

  /// The other ends of those of the first `count` cross_edges that begin in `from`. Reads as far as 31 more.
  LaneMask (*cross_edges)(const CrossEdge* cross_edges, std::size_t count, LaneMask from);

  /// What `from` reaches by the edges within a leaf, through `among` alone; `from` is a part of `among`. Reads all 32
  /// rows of `adjacency`, and uses those in `among`.
  LaneMask (*reachable)(const LaneMask* adjacency, LaneMask among, LaneMask from);

  /// Places the groups `list` of `groups`.
  void (*classify)(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball,
                   GroupContainment* out);

  /// Writes those of the 32 `ids` whose lane is set, and returns where they end. May write up to 32 behind that.
  VertexId* (*compress)(const VertexId* ids, LaneMask lanes, VertexId* out);

  [[nodiscard]] LaneMask within(const float* xyz, std::size_t size, const LeafBall& ball) const {
    return within_float(xyz, size, ball);
  }
  [[nodiscard]] LaneMask within(const double* xyz, std::size_t size, const LeafBall& ball) const {
    return within_double(xyz, size, ball);
  }
  [[nodiscard]] Nearest nearest(const float* xyz, LaneMask lanes, const LeafBall& ball) const {
    return nearest_float(xyz, lanes, ball);
  }
  [[nodiscard]] Nearest nearest(const double* xyz, LaneMask lanes, const LeafBall& ball) const {
    return nearest_double(xyz, lanes, ball);
  }

  // The same of the vertices from `first` on.
  [[nodiscard]] LaneMask within(const PositionsInOrder& positions, std::size_t first, std::size_t size,
                                const LeafBall& ball) const {
    return std::visit([&](const auto& xyz) { return within(xyz.data() + 3 * first, size, ball); }, positions);
  }
  [[nodiscard]] Nearest nearest(const PositionsInOrder& positions, std::size_t first, LaneMask lanes,
                                const LeafBall& ball) const {
    return std::visit([&](const auto& xyz) { return nearest(xyz.data() + 3 * first, lanes, ball); }, positions);
  }
};

/// As `Kernels::nearest`, vertex by vertex.
template <class Real>
[[nodiscard]] inline Nearest nearest_of(const Real* xyz, LaneMask lanes, const LeafBall& ball) {
  const std::span<const Real> vertices(xyz, 3 * kLeafCapacity);
  Nearest result{std::numeric_limits<double>::infinity(), 0};
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(lanes));
    const double square = squared_distance(point(vertices, lane), ball.centre);
    if (square < result.square) result = {square, lane};
  }
  return result;
}

/// A vertex is not the nearest if its squared distance in float is larger than this; `least` is the least of them all.
[[nodiscard]] inline float nearest_at_most(float least) { return least * (1 + 0x1p-19F) + 0x1p-138F; }

/// Those for `isa`, which the processor must have.
[[nodiscard]] const Kernels& kernels(Isa isa);

/// How much nearer than its reach a region begins to the square of a distance, for rounding in single precision.
inline constexpr float kRegionMargin = 1 - 0x1p-18F;

const Kernels& portable_kernels();
#if defined(__x86_64__) && !defined(MESHHOOD_NARROW_IDS)
#define MESHHOOD_HAS_X86 1
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();
#endif

}  // namespace meshhood
