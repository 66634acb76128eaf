// SPDX-License-Identifier: MIT
#pragma once

#include "base/frame.h"
#include "shared/distance.h"

/// A search ball as the kernels compare it: with vertices, and with bounding spheres in the frame. All margins for
/// rounding are in ball.cpp.
namespace meshhood::inline v0_1 {

/// Bounds on the squared distance of a vertex. They depend on the radius alone.
struct LeafBounds {
  double squared_radius;  // of the predicate: inside if the squared distance is <= this
  // With float positions, a vertex is inside or outside if its squared distance in single precision is beyond one of
  // these bounds. In between, the predicate decides.
  float surely_inside;   // <=
  float surely_outside;  // >

  explicit LeafBounds(double radius);
};

/// A search ball to be compared with vertices.
struct LeafBall : LeafBounds {
  Point center;
  // The center in single precision is exact where the positions are floats.
  float x;
  float y;
  float z;

  LeafBall(const Point& at, const LeafBounds& bounds)
      : LeafBounds(bounds),
        center(at),
        x(static_cast<float>(at.x)),
        y(static_cast<float>(at.y)),
        z(static_cast<float>(at.z)) {}
};

/// The radius in the frame, rounded to be compared with bounding spheres.
struct TreeBounds {
  float outer;  // no vertex farther away than this is in the ball
  float inner;  // every vertex at most this far away is in the ball

  TreeBounds(const Frame& frame, double radius);
};

/// A search ball in the frame, to be compared with bounding spheres.
struct TreeBall : TreeBounds {
  float x;
  float y;
  float z;

  TreeBall(const FramePoint& at, const TreeBounds& bounds) : TreeBounds(bounds), x(at.x), y(at.y), z(at.z) {}
  TreeBall(const Frame& frame, const Point& center, double radius)
      : TreeBall(frame.round(center), TreeBounds(frame, radius)) {}
};

/// Compares one node with the ball, with the same result as `Kernels::classify`.
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

}  // namespace meshhood::inline v0_1
