// SPDX-License-Identifier: MIT
#include "patch/sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/vector.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {
namespace {

// One of these is far from the rim, unless it is everywhere.
constexpr std::array<Point, 6> kPoles{{{0.48, 0.6, 0.64},
                                       {-0.48, -0.6, -0.64},
                                       {0.64, -0.48, -0.6},
                                       {-0.64, 0.48, 0.6},
                                       {0.6, -0.64, 0.48},
                                       {-0.6, 0.64, -0.48}}};

double squared_size(const Complex& z) { return z.real() * z.real() + z.imag() * z.imag(); }

/// Only the argument of a product counts. One is 0 if the rim meets the point where the potential is singular.
Complex rescaled(const Complex& z) {
  const double size = squared_size(z);
  return size == 0 || (size > 1e-100 && size < 1e100) ? z : (1 / std::sqrt(size)) * z;
}

/// A number whose argument is half the signed area of a spherical triangle.
Complex half_area(const Point& n, const Point& u, const Point& w) {
  return {1 + dot(n, u) + dot(u, w) + dot(w, n), dot(n, cross(u, w))};
}

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
  const double size = length(normal);
  pole_ = size > 0 ? (1 / size) * normal : kPoles[0];
  ends_.clear();
  product_ = 1;
  from_pole_ = 1;
  least_from_pole_ = kInfinity;
  sum_ = 0;
  count_ = 0;
}

void RimArcs::add(const Circle& circle, double theta, const Point& u, const Point& w) {
  const double h = circle.distance;
  const double sign = h < 0 ? -1 : 1;
  const Point n = sign * circle.normal;
  sum_ += sign * theta * (1 - sign * h);
  ++count_;
  const auto add_part = [&](const Point& from, const Point& to) {
    add_factors(std::conj(half_area(n, from, to)), half_area(pole_, from, to), from, to);
  };
  if (theta < kLongArc) return add_part(u, w);
  const Point half = circle.middle(theta, u, w);
  const Point first = circle.middle(theta / 2, u, half);
  const Point last = circle.middle(theta / 2, half, w);
  add_part(u, first);
  add_part(first, half);
  add_part(half, last);
  add_part(last, w);
}

void RimArcs::add_measured(double turn, const Complex& factor, const Complex& from_pole, const Point& u,
                           const Point& w) {
  sum_ += turn;
  ++count_;
  add_factors(factor, from_pole, u, w);
}

void RimArcs::add_factors(const Complex& factor, const Complex& from_pole, const Point& u, const Point& w) {
  product_ = rescaled(times(product_, factor));
  from_pole_ = rescaled(times(from_pole_, from_pole));
  least_from_pole_ = std::min(least_from_pole_, squared_size(from_pole));
  ends_.emplace_back(u, w);
}

void RimArcs::add_circle(double h) {
  sum_ += 2 * std::numbers::pi * (1 - h);
  ++count_;
}

double RimArcs::area_behind() const {
  constexpr double kSphere = 4 * std::numbers::pi;
  constexpr double kFarPole = 0.25;      // of the squared factor of an arc
  constexpr double kArcSlack = 0x1p-46;  // of an arc
  Complex best = times(product_, from_pole_);
  double most = least_from_pole_;
  for (const Point& pole : kPoles) {
    if (most >= kFarPole) break;
    Complex product = product_;
    double least = kFarPole;
    for (const auto& [u, w] : ends_) {
      const Complex factor = half_area(pole, u, w);
      least = std::min(least, squared_size(factor));
      if (least <= most) break;
      product = rescaled(times(product, factor));
    }
    if (least <= most) continue;
    most = least;
    best = product;
  }
  const double area = std::fmod(-(sum_ + 2 * argument(best)), kSphere);
  const double positive = area < 0 ? area + kSphere : area;
  return positive > kSphere - kArcSlack * static_cast<double>(count_ + 8) ? 0 : positive;
}

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
