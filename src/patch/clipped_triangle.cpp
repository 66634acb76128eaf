// SPDX-License-Identifier: MIT
#include "patch/clipped_triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshhood::inline v0_1 {
namespace {

constexpr double kPi = std::numbers::pi;

/// A side touches the sphere, whose radius is 1, if the square of its nearest point is off by no more: 2^-46 radii.
/// That is more than the error of the point of a side whose corners are near (see `kFar`).
constexpr double kTouch = 0x1p-45;

template <class Real>
RealVector<Real> offset(const PatchBall& ball, const Point& p) {
  return offset_of<Real>(p, ball.center, ball.scale);
}

}  // namespace

ClippedTriangle::ClippedTriangle(const PatchBall& ball, const PatchTriangle& triangle)
    : ball_(&ball), triangle_(&triangle) {
  for (std::size_t i = 0; i < 3; ++i) {
    corners_[i] = ball.unit * (triangle.corners[i] - ball.center);
    is_far_ = is_far_ || !(dot(corners_[i], corners_[i]) <= kFar * kFar);  // NaN where the unit is infinite
  }
  for (std::size_t i = 0; i < 3; ++i) {
    sides_[i].is_cut = triangle.inside[i] || triangle.inside[after(i)];
    if (sides_[i].is_cut || !may_dip(i)) continue;
    find_nearest(i);
    const double square = dot(sides_[i].nearest, sides_[i].nearest);
    sides_[i].is_cut = sides_[i].dips = sides_[i].is_between && square <= 1 + kTouch;
  }
}

/// Sets the nearest point of the line from `begin` along `whole`, both times `unit`. The side has the direction of
/// `whole` times `sign`.
template <class Real>
void ClippedTriangle::set_line(Side& side, const RealVector<Real>& begin, const RealVector<Real>& whole, double unit,
                               double sign) {
  const Real square = dot(whole, whole);
  const auto rounded = static_cast<double>(square);
  if (rounded == 0) {
    side.nearest = unit * in_double(begin);
    side.along = {0, 0, 0};
    side.is_between = false;
    return;
  }
  const Real share = Real(0) - dot(begin, whole) / square;
  side.nearest = unit * in_double(begin + share * whole);
  side.along = (sign / std::sqrt(rounded)) * in_double(whole);
  side.is_between = static_cast<double>(share) > 0 && static_cast<double>(share) < 1;
}

/// Returns whether the nearest point of a line lies between the ends and in the ball, but for rounding.
bool ClippedTriangle::may_dip(std::size_t i) const {
  if (is_far_) return true;
  const Point& a = corners_[i];
  const Point side = corners_[after(i)] - a;
  const double along = dot(a, side);
  const double square = dot(side, side);
  return along <= kTouchSlack * square && along >= -(1 + kTouchSlack) * square &&
         dot(a, a) * square - along * along <= (1 + kTouchSlack) * square;
}

/// Measures from the same end for all triangles that have the side: the one in the ball, if the other is not.
void ClippedTriangle::find_nearest(std::size_t i) {
  const bool begins = triangle_->inside[i];
  const bool ends = triangle_->inside[after(i)];
  const bool is_reversed = begins == ends ? triangle_->places[after(i)] < triangle_->places[i] : ends;
  const std::size_t begin = is_reversed ? after(i) : i;
  const std::size_t end = is_reversed ? i : after(i);
  const double sign = is_reversed ? -1 : 1;
  if (is_far_) {
    const auto from = offset<Twofold>(*ball_, triangle_->corners[begin]);
    const auto to = offset<Twofold>(*ball_, triangle_->corners[end]);
    set_line(sides_[i], from, to - from, 1 / ball_->radius, sign);
  } else {
    set_line(sides_[i], corners_[begin], corners_[end] - corners_[begin], 1, sign);
  }
}

void ClippedTriangle::find_chord(std::size_t i) {
  Side& side = sides_[i];
  if (!side.dips) find_nearest(i);
  side.half = std::sqrt(std::max(0.0, 1 - dot(side.nearest, side.nearest)));
  side.from = triangle_->inside[i] ? dot(corners_[i], side.along) : -side.half;
  side.to = triangle_->inside[after(i)] ? dot(corners_[after(i)], side.along) : side.half;
}

/// Returns the turn of the boundary at a corner between two sides that are cut.
Complex ClippedTriangle::turn_at(std::size_t corner) const {
  const Point& before = sides_[after(after(corner))].along;
  const Point& behind = sides_[corner].along;
  return {dot(before, behind), dot(plane_.circle.normal, cross(before, behind))};
}

/// Returns the angle of the arc from where side `from` leaves the ball to where the one `steps` sides later enters it.
///
/// The boundary turns at both ends of the arc, each time by the argument of (offset, half), and along the arc. All of
/// it is the turn at the corners in between: at the next corner; or, one side later, 2 pi without that at the corner
/// that both sides have; or 2 pi for the same side again. So the numbers are divided, and the angle is an argument, in
/// [0, 2 pi], or in [0, pi] for the next side, since both ends of the arc are seen from the corner that is outside.
/// Near the ends of the first range the angles themselves are subtracted.
double ClippedTriangle::angle_of_arc(std::size_t from, std::size_t steps) const {
  const Side& to = sides_[(from + steps) % 3];
  const Complex leaves{sides_[from].offset, sides_[from].half};
  const Complex enters{to.offset, to.half};
  const Complex turn = steps == 1 ? turn_at(after(from)) : steps == 2 ? std::conj(turn_at(from)) : 1;
  const Complex arc = times(turn, std::conj(times(leaves, enters)));
  const double angle = argument(arc);
  if (steps == 1) return angle >= 0 ? angle : arc.real() > 0 ? 0 : 2 * kPi + angle;
  if (std::abs(arc.imag()) > kClearTurn * arc.real()) return angle < 0 ? 2 * kPi + angle : angle;
  const double all = 2 * kPi - (steps == 2 ? std::abs(argument(turn)) : 0);  // without an area, its sign is noise
  return std::clamp(all - argument(leaves) - argument(enters), 0.0, 2 * kPi);
}

/// Returns twice the area times the normal: that of a needle from its short side, and 0 if the direction is rounding.
Point ClippedTriangle::vector_area() const {
  constexpr double kDust = 0x1p-88;  // of the square of a side
  const std::array sides{corners_[1] - corners_[0], corners_[2] - corners_[1], corners_[2] - corners_[0]};
  const std::array squares{dot(sides[0], sides[0]), dot(sides[1], sides[1]), dot(sides[2], sides[2])};
  if (std::ranges::min(squares) < kDust) return {0, 0, 0};
  return cross(sides[0], squares[1] < kNeedle * squares[0] ? sides[1] : sides[2]);
}

/// Computes the distance from the longest chord, whose line is near.
double ClippedTriangle::distance_of_plane() const {
  double longest = -1;
  Point nearest{0, 0, 0};
  for (const Side& side : sides_) {
    if (!side.is_cut || !(side.to - side.from > longest)) continue;
    longest = side.to - side.from;
    nearest = side.nearest;
  }
  return std::clamp(dot(plane_.circle.normal, nearest), -1.0, 1.0);
}

/// Finds the plane of the triangle, and whether the foot of the center on it lies in the triangle.
template <class Real>
ClippedTriangle::Plane ClippedTriangle::find_plane() const {
  std::array<RealVector<Real>, 3> corners{offset<Real>(*ball_, triangle_->corners[0]),
                                          offset<Real>(*ball_, triangle_->corners[1]),
                                          offset<Real>(*ball_, triangle_->corners[2])};
  const RealVector<Real> area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Point rounded = in_double(area);
  const double size = length(rounded);
  if (size == 0) return {};
  bool has_foot = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const RealVector<Real> over = cross(corners[i], corners[after(i)] - corners[i]);
    has_foot = has_foot && static_cast<double>(dot(area, over)) > 0;
  }
  const double distance = static_cast<double>(dot(area, corners[0])) / size / ball_->radius;
  return {{(1 / size) * rounded, distance}, has_foot};
}

void ClippedTriangle::find_outline() {
  for (std::size_t i = 0; i < 3; ++i) {
    if (sides_[i].is_cut) find_chord(i);
  }
  if (is_far_ || !is_cut()) {
    plane_ = is_far_ ? find_plane<Twofold>() : find_plane<double>();
    if (!is_cut()) return;
  } else {
    const Point area = vector_area();
    const double size = length(area);
    plane_.circle.normal = size > 0 ? (1 / size) * area : Point{0, 0, 0};
  }
  plane_.circle.distance = distance_of_plane();
  for (Side& side : sides_) {
    if (side.is_cut) side.offset = dot(side.nearest, cross(side.along, plane_.circle.normal));
  }
}

bool ClippedTriangle::touches(std::size_t i) const {
  const Side& side = sides_[i];
  const double deepest = std::clamp(0.0, side.from, std::max(side.from, side.to));
  return (side.half - deepest) * (side.half + deepest) <= kTouch;
}

ClippedTriangle::Arc ClippedTriangle::arc_from(std::size_t i) const {
  std::size_t steps = 1;
  while (!sides_[(i + steps) % 3].is_cut) ++steps;
  return {(i + steps) % 3, plane_.circle.exists() ? angle_of_arc(i, steps) : 0};
}

ClippedTriangle::Measure ClippedTriangle::measure(RimArcs& rim) {
  find_outline();
  const double distance = plane_.circle.distance;
  if (has_disc()) {
    rim.add_circle(distance);
    return {kPi * (1 - distance) * (1 + distance), distance};
  }
  if (!is_cut() || !plane_.circle.exists()) return {0, 0};
  const double disc = (1 - distance) * (1 + distance);  // the square of its radius
  double doubled = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (meets(i)) doubled += sides_[i].offset * (sides_[i].to - sides_[i].from);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!has_arc(i)) continue;
    const Arc arc = arc_from(i);
    doubled += disc * arc.angle;
    rim.add(plane_.circle, arc.angle, exit(i), entry(arc.to));
  }
  return {doubled / 2, distance};
}

void ClippedTriangle::add_to(PatchSums& sums) {
  const auto [area, distance] = measure(sums.rim());
  sums.add_cut(area, distance);
}

}  // namespace meshhood::inline v0_1
