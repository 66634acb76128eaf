// SPDX-License-Identifier: MIT
#include "exact/joint/packet.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

// Longer than any distance in the frame, so that larger radii may be replaced by it.
constexpr double kLargestRadius = 8;

// Let every vertex that is compared, and every query, lie within `a` of the center of the group, and u = 2^-24. The
// coordinates of both are rounded by u, which moves a squared distance by 8 u a^2; `2 p.q - p.p` is computed with an
// error of 12 u a^2, and a threshold is rounded by u a^2: 21 u a^2 in all, less than 2^-19 a^2. A squared distance from
// the center of the leaf is off by 28 u a^2, less than four times as much.
constexpr double kRelativeError = 0x1p-19;

double inner_of(const TreeBounds& bounds) { return std::min(static_cast<double>(bounds.inner), kLargestRadius); }
double outer_of(const TreeBounds& bounds) { return std::min(static_cast<double>(bounds.outer), kLargestRadius); }

}  // namespace

JointRadius::JointRadius(const Frame& frame, double at)
    : radius(at),
      squared(squared_radius(at)),
      bounds(frame, at),
      inner_squared(inner_of(bounds) > 0 ? inner_of(bounds) * inner_of(bounds) : -kInfinity),
      outer_squared(outer_of(bounds) * outer_of(bounds)) {}

Packet::Packet(const IndexView& index, const JointGroup& group, LeafId leaf, std::span<const JointQuery> queries)
    : index_(&index), leaf_(leaf), size_(queries.size()), ball_({0, 0, 0}, queries.front().radius.bounds) {
  assert(size_ <= kPacketCapacity);
  for (std::size_t i = 0; i < size_; ++i) {
    assert(queries[i].lane < index.leaves[leaf].size);
    lanes_[i] = queries[i].lane;
    squared_radii_[i] = queries[i].radius.squared;
    ball_.inner = std::min(ball_.inner, queries[i].radius.bounds.inner);
    ball_.outer = std::max(ball_.outer, queries[i].radius.bounds.outer);
  }
  set_balls(group, queries);
  const FrameSphere& bounds = index.leaves[leaf].bounds;
  ball_.x = bounds.x;
  ball_.y = bounds.y;
  ball_.z = bounds.z;
  ball_.inner = -next_above(static_cast<double>(bounds.radius) - static_cast<double>(ball_.inner));
  ball_.outer = next_above(static_cast<double>(ball_.outer) + static_cast<double>(bounds.radius));
}

void Packet::set_balls(const JointGroup& group, std::span<const JointQuery> queries) {
  const FrameSphere& bounds = index_->leaves[leaf_].bounds;
  const auto leaf_radius = static_cast<double>(bounds.radius);
  const double low = inner_of(ball_) - leaf_radius;
  const double high = outer_of(ball_) + leaf_radius;
  const double reach = high + leaf_radius + group.radius();
  const double error = kRelativeError * reach * reach;
  const Point center = center_of(bounds) - group.center_in_frame();
  for (PerLane<float>* coordinate : {&balls_.x, &balls_.y, &balls_.z}) coordinate->fill(0);
  balls_.center.x = static_cast<float>(center.x);
  balls_.center.y = static_cast<float>(center.y);
  balls_.center.z = static_cast<float>(center.z);
  balls_.inside_all = low > 0 ? static_cast<float>(low * low - 4 * error) : 0;
  balls_.outside_all = static_cast<float>(high * high + 4 * error);
  balls_.queries = 0;
  balls_.surely_inside.fill(kFloatInfinity);
  balls_.maybe_inside.fill(kFloatInfinity);
  LeafPoints points;
  group.read_points(leaf_, points);
  const LaneMask open = index_->open_lanes(leaf_);
  for (std::size_t i = 0; i < size_; ++i) {
    const unsigned lane = lanes_[i];
    if ((open >> lane & 1U) == 0) continue;
    balls_.queries |= QueryWord{1} << i;
    const Point q{static_cast<double>(points.x[lane]), static_cast<double>(points.y[lane]),
                  static_cast<double>(points.z[lane])};
    balls_.set(i, 2 * q);
    balls_.surely_inside[i] = static_cast<float>(dot(q, q) - queries[i].radius.inner_squared + error);
    balls_.maybe_inside[i] = static_cast<float>(dot(q, q) - queries[i].radius.outer_squared - error);
  }
}

}  // namespace meshhood::inline v0_1
