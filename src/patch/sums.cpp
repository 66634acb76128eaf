// SPDX-License-Identifier: MIT
#include "patch/sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns a number whose argument is half the signed area of a spherical triangle.
Complex half_area(const Point& n, const Point& u, const Point& w) {
  return {1 + dot(n, u) + dot(u, w) + dot(w, n), dot(n, cross(u, w))};
}

bool is_clear(const Complex& from_pole) { return std::norm(from_pole) >= kClearPole; }

/// Only the argument of a factor counts. A factor is exactly 0 if an end lies where the potential is singular.
Complex not_zero(const Complex& z) { return z == Complex(0) ? 1 : z; }

/// Multiplies by a power of the radius, which may be infinite: then no triangle is cut.
double times_power(double sum, double power) { return sum == 0 ? 0 : sum * power; }

}  // namespace

Point Circle::middle(double theta, const Point& u, const Point& w) const {
  const Point foot = distance * normal;
  const Point chord = w - u;
  const bool is_nearly_whole = theta > 1.5 * std::numbers::pi;
  const Point toward = is_nearly_whole ? 2.0 * foot - (u + w) : cross(chord, normal);
  const double size = length(toward);
  return size > 0 ? foot + (radius() / size) * toward : foot;
}

void RimArcs::clear(const Point& normal) {
  // The pole is oblique, so that the singular point is none of those where symmetric surfaces have corners and sides.
  const Point oblique{0.0731, -0.0417, 0.0593};
  const double size = length(normal);
  const Point about = (size > 0 ? (1 / size) * normal : Point{0, 0, 1}) + oblique;
  pole_ = (1 / length(about)) * about;
  const Point beside = cross(pole_, std::abs(pole_.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0});
  other_ = (1 / length(beside)) * beside;
  real_ = 1;
  imaginary_ = 0;
  sum_ = 0;
  count_ = 0;
}

Complex RimArcs::from_pole(const Point& u, const Point& w) const {
  const Complex factor = half_area(pole_, u, w);
  if (is_clear(factor)) return factor;
  const Complex between =
      times(not_zero(half_area(pole_, u, other_)), std::conj(not_zero(half_area(pole_, w, other_))));
  return times(half_area(other_, u, w), (1 / std::sqrt(std::norm(between))) * between);
}

void RimArcs::add(const Circle& circle, double theta, const Point& u, const Point& w) {
  const double h = circle.distance;
  const double sign = h < 0 ? -1 : 1;
  const Point n = sign * circle.normal;
  sum_ += sign * theta * (1 - sign * h);
  const auto add_part = [&](const Point& from, const Point& to) {
    add_factor(times(std::conj(half_area(n, from, to)), from_pole(from, to)));
  };
  // Half a long arc from near the opposite of one pole does not lead near that of the other.
  if (theta < (is_clear(half_area(pole_, u, w)) ? kLongArc : kLongArc / 2)) return add_part(u, w);
  const Point half = circle.middle(theta, u, w);
  const Point first = circle.middle(theta / 2, u, half);
  const Point last = circle.middle(theta / 2, half, w);
  add_part(u, first);
  add_part(first, half);
  add_part(half, last);
  add_part(last, w);
}

/// A factor is below 2^5, and above 2^-6 unless it is that of an arc near the opposite of the pole. So a product of 64
/// neither overflows nor vanishes.
void RimArcs::rescale() {
  const double size = std::sqrt(real_ * real_ + imaginary_ * imaginary_);
  if (size == 0) return;
  real_ /= size;
  imaginary_ /= size;
}

void RimArcs::add_circle(double h) {
  sum_ += 2 * std::numbers::pi * (1 - h);
  ++count_;
}

double RimArcs::area_behind() const {
  constexpr double kSphere = 4 * std::numbers::pi;
  constexpr double kArcSlack = 0x1p-46;  // of an arc
  const double area = std::fmod(-(sum_ + 2 * argument({real_, imaginary_})), kSphere);
  const double positive = area < 0 ? area + kSphere : area;
  return positive > kSphere - kArcSlack * static_cast<double>(count_ + 8) ? 0 : positive;
}

void PatchSums::clear(const Point& normal) {
  rim_.clear(normal);
  has_border_ = false;
  area_ = moment_ = 0;
  cut_area_ = cut_moment_ = 0;
}

double PatchSums::area(const PatchBall& ball) const {
  const double r = ball.radius;
  return (area_ + times_power(cut_area_, r * r)) / ball.scale / ball.scale;
}

/// The arcs tell the area behind up to all of the sphere, and so the volume up to that of the ball. It is neither
/// negative nor larger than the ball, which a surface that intersects itself might enclose more than once.
///
/// A result below 0 by no more than its error becomes 0. A term of the moment is the area of a triangle times a part of
/// the offset of a corner from the center, which is at most the radius, and less than 4 in the frame. So its error is a
/// few 2^-53 of area times offset, and that of a needle as many times more as it is longer than high: the slack has
/// room for 1000. A body as thin as 2^-41 radii, or units of the frame, is below it, too.
double PatchSums::volume(const PatchBall& ball) const {
  constexpr double kSlack = 0x1p-40;
  if (has_border_) return kNan;
  const double r = ball.radius;
  const double area = area_ + times_power(cut_area_, r * r);
  const double moment = moment_ + times_power(cut_moment_, r * r * r);
  double triple = moment + times_power(rim_.empty() ? 0 : rim_.area_behind(), r * r * r);
  const double ball_triple = times_power(4 * std::numbers::pi, r * r * r);
  const double slack = kSlack * area * std::min(r, 4.0);
  if (std::abs(triple) > ball_triple + slack) triple = std::fmod(triple, ball_triple);
  if (triple < -slack) triple += ball_triple;
  return std::max(0.0, triple) / 3;
}

}  // namespace meshhood::inline v0_1
