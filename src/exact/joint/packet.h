// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "exact/joint/group.h"
#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// A radius in the forms that are compared: in the frame, and exactly.
struct JointRadius {
  double radius;
  double squared;  // of the predicate
  TreeBounds bounds;
  double inner_squared;  // of `bounds`; minus infinity if it is no ball
  double outer_squared;

  JointRadius(const Frame& frame, double at);
};

/// A query of a packet: a vertex of its leaf, and a radius.
struct JointQuery {
  unsigned lane;
  JointRadius radius;
};

/// Up to 32 queries from one leaf, ready to be compared with spheres and vertices.
class Packet {
 public:
  /// `queries` are 1 to 32 from `leaf`, which is one of those that `group` began with.
  Packet(const IndexView& index, const JointGroup& group, LeafId leaf, std::span<const JointQuery> queries);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Those whose vertex is not a wall. The others have no ball.
  [[nodiscard]] QueryWord queries() const { return balls_.queries; }
  [[nodiscard]] const PacketBalls& balls() const { return balls_; }
  [[nodiscard]] LeafId leaf() const { return leaf_; }
  [[nodiscard]] unsigned lane(std::size_t query) const { return lanes_[query]; }

  /// Around the leaf: `outer` around all balls, `inner` within each.
  [[nodiscard]] const TreeBall& ball() const { return ball_; }

  /// The exact predicate.
  [[nodiscard]] bool holds(std::size_t query, const Point& vertex) const {
    return squared_distance(vertex, index_->position(leaf_, lanes_[query])) <= squared_radii_[query];
  }

 private:
  void set_balls(const JointGroup& group, std::span<const JointQuery> queries);

  const IndexView* index_;
  LeafId leaf_;
  std::size_t size_;
  TreeBall ball_;
  PacketBalls balls_;
  std::array<unsigned, kPacketCapacity> lanes_;
  std::array<double, kPacketCapacity> squared_radii_;
};

}  // namespace meshhood::inline v0_1
