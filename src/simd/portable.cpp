// SPDX-License-Identifier: MIT
#include <bit>
#include <span>

#include "simd/kernels.h"

namespace meshhood {
namespace {

template <class Real>
LaneMask within(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point p = point(std::span(xyz, 3 * size), i);
    result |= LaneMask{squared_distance(p, ball.center) <= ball.squared_radius} << i;
  }
  return result;
}

LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  LaneMask result = 0;
  for (const CrossEdge& edge : edges) result |= (from >> edge.from & 1U) << edge.to;
  return result;
}

LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0 && reached != among;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & among & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

GroupContainment classify_group(const Group& group, const TreeBall& ball) {
  GroupContainment result{0, 0};
  for (unsigned i = 0; i < kFanOut; ++i) {
    const float x = ball.x - group.x[i];
    const float y = ball.y - group.y[i];
    const float z = ball.z - group.z[i];
    const float square = (x * x + y * y) + z * z;
    const float far = ball.outer + group.radius[i];
    const float near = ball.inner - group.radius[i];
    const bool outside = square > far * far;
    const bool inside = near > 0 && square < near * near;
    result.inside = static_cast<std::uint8_t>(result.inside | unsigned{inside} << i);
    result.intersecting = static_cast<std::uint8_t>(result.intersecting | unsigned{!outside && !inside} << i);
  }
  return result;
}

void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball, GroupContainment* out) {
  for (const std::uint32_t group : list) *out++ = classify_group(groups[group], ball);
}

VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  for (; lanes != 0; lanes &= lanes - 1) *out++ = ids[std::countr_zero(lanes)];
  return out;
}

}  // namespace

const Kernels& portable_kernels() {
  static constexpr Kernels kAll{within<float>, within<double>, cross_edges, reachable, classify, compress};
  return kAll;
}

}  // namespace meshhood
