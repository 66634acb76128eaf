// SPDX-License-Identifier: MIT
#include "region/triangle_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "base/vector.h"

namespace meshhood {
namespace {

bool is_before(const Point& a, const Point& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

double length_of(const Point& offset) {
  return std::sqrt((offset.x * offset.x + offset.y * offset.y) + offset.z * offset.z);
}

/// Which share of the way from `a` to `b` leads to the point nearest to the origin. Ends have exactly 0 and 1.
double share_of_side(const Point& a, const Point& b) {
  const Point side = b - a;
  const double square = dot(side, side);
  if (square == 0) return 0;
  const double share = -dot(a, side) / square;
  return share > 0 ? std::min(share, 1.0) : 0;  // 0 where it is not a number
}

class Candidates {
 public:
  Candidates(const Point& q, const std::array<Point, 3>& corners, double scale) : corners_(&corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      from_q_[i] = corners[i] - q;
      scaled_[i] = scale * from_q_[i];
      sides_[i] = scale * (corners[(i + 1) % 3] - corners[i]);
    }
  }

  TrianglePoint best() {
    for (std::size_t i = 0; i < 3; ++i) offer_side(i, (i + 1) % 3);
    offer_inside();
    return best_;
  }

 private:
  /// The nearest point of a side, seen from the same end by all triangles that have it.
  void offer_side(std::size_t i, std::size_t j) {
    if (is_before((*corners_)[j], (*corners_)[i])) std::swap(i, j);
    const double share = share_of_side(scaled_[i], scaled_[j]);
    std::array<double, 3> weights{};
    if (share == 0 || share == 1) {
      const std::size_t end = share == 0 ? i : j;
      weights[end] = 1;
      offer(weights, (*corners_)[end], from_q_[end]);
      return;
    }
    weights[i] = 1 - share;
    weights[j] = share;
    const Point side = share * ((*corners_)[j] - (*corners_)[i]);
    offer(weights, (*corners_)[i] + side, from_q_[i] + side);
  }

  /// The foot of the perpendicular, if it lies in the triangle.
  void offer_inside() {
    const Point normal = cross(sides_[0], sides_[1]);
    const double square = dot(normal, normal);
    if (square == 0) return;
    const double second = dot(normal, cross(scaled_[0], sides_[2])) / square;
    const double third = dot(normal, cross(scaled_[0], sides_[0])) / square;
    if (!(second > 0 && third > 0 && second + third < 1)) return;
    const Point across = second * ((*corners_)[1] - (*corners_)[0]) + third * ((*corners_)[2] - (*corners_)[0]);
    offer({std::max((1 - second) - third, 0.0), second, third}, (*corners_)[0] + across, from_q_[0] + across);
  }

  void offer(const std::array<double, 3>& weights, const Point& point, const Point& offset) {
    const double distance = length_of(offset);
    if (has_one_ && !(distance < best_.distance)) return;
    has_one_ = true;
    best_ = {weights, point, distance};
  }

  const std::array<Point, 3>* corners_;
  std::array<Point, 3> from_q_;
  std::array<Point, 3> scaled_;  // the same in units of the frame
  std::array<Point, 3> sides_;
  TrianglePoint best_{};
  bool has_one_ = false;
};

}  // namespace

TrianglePoint nearest_in_triangle(const Point& q, const std::array<Point, 3>& corners, double scale) {
  return Candidates(q, corners, scale).best();
}

}  // namespace meshhood
