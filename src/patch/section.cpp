// SPDX-License-Identifier: MIT
#include "patch/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "base/vector.h"
#include "patch/twofold.h"

namespace meshhood {
namespace {

using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;

// A corner farther away than so many radii is far. The nearest point of a line is off by a few 2^-53 of its corners'
// distance: below 1e-13 of the radius.
constexpr double kFar = 64;

constexpr std::size_t after(std::size_t i) { return i == 2 ? 0 : i + 1; }

Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// A unit vector, or 0.
Point direction(const Point& p) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (largest == 0) return {0, 0, 0};
  const Point q{p.x / largest, p.y / largest, p.z / largest};
  return (1 / length(q)) * q;
}

Point divided(const Point& p, double by) { return {p.x / by, p.y / by, p.z / by}; }

/// From the center, in the frame. Scaling by a power of two does not round.
template <class Real>
Vector<Real> offset(const PatchBall& ball, const Point& p) {
  const auto axis = [&](double x, double center) -> Real {
    if constexpr (std::is_same_v<Real, double>) {
      return ball.scale * (x - center);
    } else {
      return Twofold::sum(ball.scale * x, -ball.scale * center);
    }
  };
  return {axis(p.x, ball.center.x), axis(p.y, ball.center.y), axis(p.z, ball.center.z)};
}

bool is_far(const PatchBall& ball, const PatchTriangle& triangle) {
  const double reach = kFar * ball.radius / ball.scale;
  return std::ranges::any_of(triangle.corners,
                             [&](const Point& p) { return squared_distance(p, ball.center) > reach * reach; });
}

}  // namespace

Section::Section(const PatchBall& ball, const PatchTriangle& triangle) : inside_(triangle.inside) {
  if (is_far(ball, triangle)) {
    find_lines<Twofold>(ball, triangle);
  } else {
    find_lines<double>(ball, triangle);
  }
}

template <class Real>
void Section::find_lines(const PatchBall& ball, const PatchTriangle& triangle) {
  std::array<Vector<Real>, 3> corners{offset<Real>(ball, triangle.corners[0]), offset<Real>(ball, triangle.corners[1]),
                                      offset<Real>(ball, triangle.corners[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    // From the same end for all triangles that have the side.
    const bool is_reversed = triangle.places[after(i)] < triangle.places[i];
    const Vector<Real>& begin = corners[is_reversed ? after(i) : i];
    const Vector<Real> whole = corners[is_reversed ? i : after(i)] - begin;
    const Real square = dot(whole, whole);
    Side& side = sides_[i];
    if (static_cast<double>(square) == 0) {
      side.nearest = divided(begin.round(), ball.radius);
      side.is_cut = inside_[i];
      continue;
    }
    const Real share = Real(0) - dot(begin, whole) / square;
    side.nearest = divided((begin + share * whole).round(), ball.radius);
    side.along = direction((is_reversed ? -1.0 : 1.0) * whole.round());
    const auto rounded = static_cast<double>(share);
    side.dips = !inside_[i] && !inside_[after(i)] && rounded > 0 && rounded < 1 && dot(side.nearest, side.nearest) <= 1;
    find_chord(ball, triangle, i);
  }
  const Vector<Real> area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  normal_ = direction(area.round());
  const Real size = Real(length(area.round()));
  if (static_cast<double>(size) > 0) far_distance_ = static_cast<double>(dot(area, corners[0]) / size) / ball.radius;
}

void Section::find_chord(const PatchBall& ball, const PatchTriangle& triangle, std::size_t i) {
  Side& side = sides_[i];
  side.is_cut = side.dips || inside_[i] || inside_[after(i)];
  if (!side.is_cut) return;
  side.half = std::sqrt(std::max(0.0, 1 - dot(side.nearest, side.nearest)));
  const auto along = [&](std::size_t corner) {
    return dot(offset<double>(ball, triangle.corners[corner]).round(), side.along) / ball.radius;
  };
  side.from = inside_[i] ? along(i) : -side.half;
  side.to = inside_[after(i)] ? along(after(i)) : side.half;
}

/// The turn of the boundary at a corner, as a complex number of size 1.
Complex Section::turn_at(std::size_t corner) const {
  const Point& before = sides_[after(after(corner))].along;
  const Point& behind = sides_[corner].along;
  return {dot(before, behind), dot(normal_, cross(before, behind))};
}

/// The angle of the arc from where side `from` leaves the ball to where the one `steps` sides later enters it.
///
/// The boundary turns at both ends of the arc, each time by arg(offset + i half), and along the arc. All of it is the
/// turn at the corners in between, 2 pi for the same side again. So the numbers are divided, and the angle is an
/// argument in [0, 2 pi]; in [0, pi] for the next side, since both ends are seen from the corner that is outside. Near
/// the ends of the first range the angles themselves are subtracted.
double Section::angle_of_arc(std::size_t from, std::size_t steps) const {
  const std::size_t to = (from + steps) % 3;
  const Complex leaves{sides_[from].offset, sides_[from].half};
  const Complex enters{sides_[to].offset, sides_[to].half};
  Complex turn = 1;
  if (steps != 3) turn = turn_at(after(from));
  if (steps == 2) turn = times(turn, turn_at(to));
  const Complex arc = times(times(turn, std::conj(leaves)), std::conj(enters));
  const double angle = std::arg(arc);
  if (steps == 1) return angle >= 0 ? angle : arc.real() > 0 ? 0 : 2 * kPi + angle;
  if (std::abs(arc.imag()) > 1e-6 * arc.real()) return angle < 0 ? 2 * kPi + angle : angle;
  const double all = steps == 3 ? 2 * kPi : std::arg(turn_at(after(from))) + std::arg(turn_at(to));
  return std::clamp(all - std::arg(leaves) - std::arg(enters), 0.0, 2 * kPi);
}

/// From the longest chord, whose line is near.
double Section::distance_of_plane() const {
  double longest = 0;
  double distance = far_distance_;
  for (const Side& side : sides_) {
    if (!(side.to - side.from > longest)) continue;
    longest = side.to - side.from;
    distance = dot(normal_, side.nearest);
  }
  return std::clamp(distance, -1.0, 1.0);
}

/// Of a plane that meets the ball, but not on the sides.
bool Section::contains_disc() const {
  return std::abs(far_distance_) < 1 && std::ranges::all_of(sides_, [](const Side& side) { return side.offset > 0; });
}

Section::Measure Section::measure(RimArcs& rim) {
  if (normal_.x == 0 && normal_.y == 0 && normal_.z == 0) return {0, 0};
  const double distance = distance_of_plane();
  const double disc = (1 - distance) * (1 + distance);  // the square of its radius
  double doubled = 0;
  for (Side& side : sides_) {
    side.offset = dot(side.nearest, cross(side.along, normal_));
    if (side.is_cut) doubled += side.offset * (side.to - side.from);
  }
  bool is_cut = false;
  for (std::size_t i = 0; i < 3; ++i) {
    is_cut |= sides_[i].is_cut;
    if (!sides_[i].is_cut || inside_[after(i)]) continue;
    std::size_t steps = 1;
    while (!sides_[(i + steps) % 3].is_cut) ++steps;
    const Side& next = sides_[(i + steps) % 3];
    const double angle = angle_of_arc(i, steps);
    doubled += disc * angle;
    rim.add(normal_, distance, angle, sides_[i].nearest + sides_[i].half * sides_[i].along,
            next.nearest - next.half * next.along);
  }
  if (!is_cut && contains_disc()) {
    doubled = 2 * kPi * disc;
    rim.add_circle(distance);
  }
  return {doubled / 2, distance};
}

}  // namespace meshhood
