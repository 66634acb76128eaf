// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "exact/layout.h"
#include "simd/ball.h"

namespace meshhood::inline v0_1 {

/// What depends on the radius alone. A searcher keeps it for the next query, because most have equal radii.
struct RadiusBounds {
  double radius;
  double radius_in_frame;
  LeafBounds leaf;
  TreeBounds tree;

  RadiusBounds(const Frame& frame, double r) : radius(r), radius_in_frame(r * frame.scale), leaf(r), tree(frame, r) {}
};

/// One query: its vertex, its radius, and its ball in each form that a step of the search compares with.
struct Query {
  VertexId vertex;
  std::uint32_t slot;
  double radius;
  double radius_in_frame;
  LeafBall ball;       // for vertices: the exact predicate, and its filter in single precision
  TreeBall tree_ball;  // for nodes

  Query(const IndexView& index, VertexId v, const RadiusBounds& bounds)
      : vertex(v),
        slot(index.slot[v]),
        radius(bounds.radius),
        radius_in_frame(bounds.radius_in_frame),
        ball(index.position_at(slot), bounds.leaf),
        tree_ball(index.frame.round(ball.center), bounds.tree) {}

  [[nodiscard]] LeafId leaf() const { return leaf_of(slot); }
  [[nodiscard]] LaneMask lane() const { return LaneMask{1} << lane_of(slot); }
};

}  // namespace meshhood::inline v0_1
