// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "exact/layout.h"
#include "simd/ball.h"

namespace meshhood {

/// What depends on the radius alone. A searcher keeps it from one query to the next, because most have equal radii.
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
      : Query(index, v, index.slot[v], index.position(leaf_of(index.slot[v]), lane_of(index.slot[v])), bounds) {}

  [[nodiscard]] LeafId leaf() const { return leaf_of(slot); }
  [[nodiscard]] LaneMask lane() const { return LaneMask{1} << lane_of(slot); }
  [[nodiscard]] const Point& center() const { return ball.center; }

 private:
  Query(const IndexView& index, VertexId v, std::uint32_t slot_of_v, const Point& center, const RadiusBounds& bounds)
      : vertex(v),
        slot(slot_of_v),
        radius(bounds.radius),
        radius_in_frame(bounds.radius_in_frame),
        ball(center, bounds.leaf),
        tree_ball(index.frame.round(center), bounds.tree) {}
};

}  // namespace meshhood
