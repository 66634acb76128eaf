// SPDX-License-Identifier: MIT
#include "patch/sums.h"

#include <numbers>

#include "base/vector.h"

namespace meshhood::inline v0_1 {

void PatchSums::clear(const Point& normal) {
  rim_.clear(normal);
  has_border_ = false;
  area_ = 0;
  moment_ = 0;
}

void PatchSums::add_cut(double area, double distance, const PatchBall& ball) {
  const double r = ball.radius;
  area_ += area * r * r;
  moment_ += area * distance * r * r * r;
}

void PatchSums::add_cut(ClippedTriangle& clipped, const PatchBall& ball) {
  const auto [area, distance] = clipped.measure(rim_);
  add_cut(area, distance, ball);
}

double PatchSums::area(const PatchBall& ball) const { return area_ / ball.scale / ball.scale; }

double PatchSums::volume(const PatchBall& ball) const {
  if (has_border_) return kNan;
  const double r = ball.radius;
  const bool is_inward = rim_.empty() && moment_ < 0;  // all of the ball but what the patch encloses
  const double behind = is_inward ? 4 * std::numbers::pi : rim_.empty() ? 0 : rim_.area_behind();
  const double cone = behind == 0 ? 0 : behind * r * r * r;
  return (moment_ + cone) / 3 / ball.scale / ball.scale / ball.scale;
}

}  // namespace meshhood::inline v0_1
