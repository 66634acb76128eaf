// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "simd/kernels.h"

/// The kernels as plain loops, a lane after the other: what those of each instruction set are compared with.
namespace meshhood::test {
namespace plain {

template <class Real>
LaneMask within(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point p = point(std::span(xyz, 3 * size), i);
    result |= LaneMask{squared_distance(p, ball.center) <= ball.squared_radius} << i;
  }
  return result;
}

template <class Real>
LaneMask squares(const Real* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out) {
  for (std::size_t i = 0; i < size; ++i) out[i] = squared_distance(point(std::span(xyz, 3 * size), i), ball.center);
  return within(xyz, size, ball);
}

inline LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  LaneMask result = 0;
  for (const CrossEdge& edge : edges) result |= (from >> edge.from & 1U) << edge.to;
  return result;
}

inline LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0 && reached != among;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & among & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

inline GroupContainment classify_group(const Group& group, const TreeBall& ball) {
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

inline void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball,
                     GroupContainment* out) {
  for (const std::uint32_t group : list) *out++ = classify_group(groups[group], ball);
}

inline unsigned box_squares(const BoxGroup& boxes, const FramePoint& center, float limit, BoxGroup::Row& squares) {
  unsigned near = 0;
  for (unsigned i = 0; i < kFanOut; ++i) {
    const auto gap = [i](float at, const BoxGroup::Row& low, const BoxGroup::Row& high) {
      return at < low[i] ? low[i] - at : std::max(at - high[i], 0.0F);
    };
    const float x = gap(center.x, boxes.low.x, boxes.high.x);
    const float y = gap(center.y, boxes.low.y, boxes.high.y);
    const float z = gap(center.z, boxes.low.z, boxes.high.z);
    squares[i] = (x * x + y * y) + z * z;
    near |= unsigned{squares[i] <= limit} << i;
  }
  return near;
}

inline unsigned box_entries(const BoxGroup& boxes, const BoxRay& ray, float limit, BoxGroup::Row& entries) {
  unsigned met = 0;
  for (unsigned i = 0; i < kFanOut; ++i) {
    float entry = 0;
    float exit = limit;
    const auto cross_slab = [&](const BoxRay::Axis& axis, float low, float high) {
      float enters = (low - axis.low) * axis.inverse;
      float leaves = (high - axis.high) * axis.inverse;
      if (axis.inverse < 0) std::swap(enters, leaves);
      entry = std::max(entry, enters);
      exit = std::min(exit, leaves);
    };
    cross_slab(ray.x, boxes.low.x[i], boxes.high.x[i]);
    cross_slab(ray.y, boxes.low.y[i], boxes.high.y[i]);
    cross_slab(ray.z, boxes.low.z[i], boxes.high.z[i]);
    entries[i] = entry;
    met |= unsigned{entry <= exit * kExitSlack} << i;
  }
  return met;
}

inline VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  for (; lanes != 0; lanes &= lanes - 1) *out++ = ids[std::countr_zero(lanes)];
  return out;
}

inline void count_less(const double* numbers, std::size_t count, std::uint64_t* less) {
  const std::span all(numbers, count);
  for (std::size_t i = 0; i < count; ++i) {
    less[i] = static_cast<std::uint64_t>(std::ranges::count_if(all, [&](double other) { return other < all[i]; }));
  }
}

}  // namespace plain

inline constexpr Kernels kPlainKernels{plain::within<float>,   plain::within<double>, plain::squares<float>,
                                       plain::squares<double>, plain::cross_edges,    plain::reachable,
                                       plain::classify,        plain::box_squares,    plain::box_entries,
                                       plain::compress,        plain::count_less,     0};

}  // namespace meshhood::test
