// SPDX-License-Identifier: MIT
#include <bit>
#include <span>

#include "search/simd.h"

namespace meshhood {
namespace {

template <class Real>
Lanes within(const Real* xyz, std::size_t size, const LeafBall& ball) {
  Lanes result = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point p = point(std::span(xyz, 3 * size), i);
    result |= Lanes{squared_distance(p, ball.centre) <= ball.squared_radius} << i;
  }
  return result;
}

Lanes cross(const Crossing* crossings, std::size_t count, Lanes from) {
  Lanes result = 0;
  for (std::size_t i = 0; i < count; ++i) result |= (from >> crossings[i].mine & 1U) << crossings[i].other;
  return result;
}

Lanes spread(const Lanes* adjacency, Lanes among, Lanes from) {
  Lanes reached = from;
  for (Lanes todo = from; todo != 0 && reached != among;) {
    const Lanes added = adjacency[std::countr_zero(todo)] & among & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

Placements place_group(const Group& group, const TreeBall& ball) {
  Placements result{0, 0, 0};
  for (unsigned i = 0; i < kFanOut; ++i) {
    const float x = ball.x - group.x[i];
    const float y = ball.y - group.y[i];
    const float z = ball.z - group.z[i];
    const float square = (x * x + y * y) + z * z;
    const float far = ball.outer + group.radius[i];
    const float near = ball.inner - group.radius[i];
    const bool outside = square > far * far;
    const bool inside = near > 0 && square < near * near;
    const float height = (x * group.axis_x[i] + y * group.axis_y[i]) + z * group.axis_z[i];
    const float reach = group.reach[i] + (height < 0 ? -height : height);
    const bool clear = square * kColumnMargin > reach * reach;
    result.inside = static_cast<std::uint8_t>(result.inside | unsigned{inside} << i);
    result.straddling = static_cast<std::uint8_t>(result.straddling | unsigned{!outside && !inside} << i);
    result.doubtful = static_cast<std::uint8_t>(result.doubtful | unsigned{!clear} << i);
  }
  return result;
}

void place(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball, Placements* out) {
  for (const std::uint32_t group : list) *out++ = place_group(groups[group], ball);
}

VertexId* append(const VertexId* ids, Lanes lanes, VertexId* out) {
  for (; lanes != 0; lanes &= lanes - 1) *out++ = ids[std::countr_zero(lanes)];
  return out;
}

}  // namespace

const Kernels& portable_kernels() {
  static constexpr Kernels kAll{within<float>, within<double>, nearest_of<float>, nearest_of<double>, cross, spread,
                                place,         append};
  return kAll;
}

}  // namespace meshhood
