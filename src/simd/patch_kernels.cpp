// SPDX-License-Identifier: MIT
// `PatchKernels`, compiled once for each target; see lanes-inl.h. The formulas are those of `ClippedTriangle` and
// `RimArcs` for the one arc of a triangle of which no corner is far.
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "simd/patches.h"

#define HWY_TARGET_INCLUDE "simd/patch_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

using Vectors = Points<Doubles>;
using Lanes = hn::Mask<Doubles>;

HWY_INLINE Numbers chosen(Lanes lanes, Numbers yes, Numbers no) { return either(Doubles(), lanes, yes, no); }

HWY_INLINE Vectors chosen(Lanes lanes, const Vectors& yes, const Vectors& no) {
  return {chosen(lanes, yes.x, no.x), chosen(lanes, yes.y, no.y), chosen(lanes, yes.z, no.z)};
}

HWY_INLINE Vectors sum(const Vectors& a, const Vectors& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vectors vector_product(const Vectors& a, const Vectors& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE Numbers negated(Numbers x) { return hn::Sub(hn::Zero(Doubles()), x); }

/// A complex number for each lane.
struct Turns {
  Numbers real;
  Numbers imaginary;
};

HWY_INLINE Turns product(const Turns& a, const Turns& b) {
  return {hn::Sub(hn::Mul(a.real, b.real), hn::Mul(a.imaginary, b.imaginary)),
          hn::Add(hn::Mul(a.real, b.imaginary), hn::Mul(a.imaginary, b.real))};
}

/// `argument` of numbers that are not 0.
HWY_INLINE Numbers arguments(const Turns& numbers) {
  const auto zero = hn::Zero(Doubles());
  const auto half_pi = splat(std::numbers::pi / 2);
  const auto x = hn::Abs(numbers.real);
  const auto y = hn::Abs(numbers.imaginary);
  const auto is_upright = hn::Gt(y, x);
  const auto low = chosen(is_upright, x, y);
  const auto high = chosen(is_upright, y, x);
  const auto is_steep = hn::Gt(low, hn::Mul(splat(0.66), high));
  const auto t = hn::Div(chosen(is_steep, hn::Sub(low, high), low), chosen(is_steep, hn::Add(low, high), high));
  const auto z = hn::Mul(t, t);
  auto above = splat(kArctangentAbove[0]);
  for (std::size_t i = 1; i < kArctangentAbove.size(); ++i) {
    above = hn::Add(hn::Mul(above, z), splat(kArctangentAbove[i]));
  }
  auto below = hn::Add(z, splat(kArctangentBelow[0]));
  for (std::size_t i = 1; i < kArctangentBelow.size(); ++i) {
    below = hn::Add(hn::Mul(below, z), splat(kArctangentBelow[i]));
  }
  const auto small = hn::Add(t, hn::Mul(t, hn::Div(hn::Mul(z, above), below)));
  const auto eighth = hn::Add(chosen(is_steep, splat(std::numbers::pi / 4), zero), small);
  const auto quarter = chosen(is_upright, hn::Sub(half_pi, eighth), eighth);
  const auto half = chosen(hn::Lt(numbers.real, zero), hn::Sub(splat(std::numbers::pi), quarter), quarter);
  return chosen(hn::Lt(numbers.imaginary, zero), negated(half), half);
}

/// `half_area` of src/patch/sums.cpp.
HWY_INLINE Turns half_areas(const Vectors& n, const Vectors& u, const Vectors& w) {
  const auto products =
      hn::Add(hn::Add(hn::Add(splat(1.0), scalar_product(n, u)), scalar_product(u, w)), scalar_product(w, n));
  return {products, scalar_product(n, vector_product(u, w))};
}

/// The line of a side: its point nearest to the center, its direction, and half the chord.
struct Line {
  HWY_INLINE Line(const Vectors& first, const Vectors& last, Numbers direction) {
    const Lanes is_reversed = hn::Lt(direction, hn::Zero(Doubles()));
    const auto begin = chosen(is_reversed, last, first);
    const auto whole = difference(chosen(is_reversed, first, last), begin);
    square = squared_length(whole);
    const auto share = negated(hn::Div(scalar_product(begin, whole), square));
    nearest = sum(begin, scaled(whole, share));
    along = scaled(whole, hn::Div(direction, hn::Sqrt(square)));
    const auto rest = hn::Sub(splat(1.0), squared_length(nearest));
    half = hn::Sqrt(hn::Max(hn::Zero(Doubles()), rest));
  }

  HWY_INLINE void set_offset(const Vectors& normal) { offset = scalar_product(nearest, vector_product(along, normal)); }

  Numbers square;  // of the length of the side
  Vectors nearest;
  Vectors along;
  Numbers half;
  Numbers from{};  // the part of the side in the ball, from `nearest` on
  Numbers to{};
  Numbers offset{};  // from the foot of the center on the plane
};

/// `ClippedTriangle::may_dip`.
HWY_INLINE Lanes may_dip(const Vectors& a, const Vectors& b) {
  const auto more = splat(1 + kTouchSlack);
  const auto side = difference(b, a);
  const auto along = scalar_product(a, side);
  const auto square = squared_length(side);
  const auto depth = hn::Sub(hn::Mul(squared_length(a), square), hn::Mul(along, along));
  return hn::And(
      hn::And(hn::Le(along, hn::Mul(splat(kTouchSlack), square)), hn::Ge(along, negated(hn::Mul(more, square)))),
      hn::Le(depth, hn::Mul(more, square)));
}

/// From the center, in units of the radius.
struct Corners {
  HWY_INLINE Corners(const CutTriangles& cut, std::size_t i)
      : center(load_rows(Doubles(), cut.centers, i)),
        unit(load(cut.units[i])),
        a(corner(cut.corners[0], i)),
        b(corner(cut.corners[1], i)),
        c(corner(cut.corners[2], i)) {}

  HWY_INLINE Vectors corner(const PointPerLane<double>& corners, std::size_t i) const {
    return scaled(difference(load_rows(Doubles(), corners, i), center), unit);
  }

  HWY_INLINE Lanes are_near() const {
    const auto farthest = hn::Max(squared_length(a), hn::Max(squared_length(b), squared_length(c)));
    return hn::Le(farthest, splat(kFar * kFar));
  }

  Vectors center;
  Numbers unit;
  Vectors a;
  Vectors b;
  Vectors c;
};

/// Those from `i` on, a vector.
HWY_INLINE LaneMask measure_vector(const CutTriangles& cut, std::size_t i, ClippedTriangles& clipped) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto one = splat(1.0);
  const Corners corners(cut, i);
  const auto& [center, unit, a, b, c] = corners;
  const auto sign = load(cut.insides[i]);
  const Lanes inside = hn::Gt(sign, zero);

  Line first(a, b, load(cut.directions[0][i]));
  Line middle(b, c, load(cut.directions[1][i]));
  Line last(c, a, load(cut.directions[2][i]));
  first.from = chosen(inside, scalar_product(a, first.along), negated(first.half));
  first.to = chosen(inside, first.half, scalar_product(b, first.along));
  middle.from = scalar_product(b, middle.along);
  middle.to = scalar_product(c, middle.along);
  last.from = chosen(inside, negated(last.half), scalar_product(c, last.along));
  last.to = chosen(inside, scalar_product(a, last.along), last.half);

  const auto area = vector_product(difference(b, a), difference(c, a));
  const auto size = hn::Sqrt(squared_length(area));
  const auto normal = scaled(area, hn::Div(one, size));
  const auto first_chord = hn::Sub(first.to, first.from);
  const auto middle_chord = chosen(inside, zero, hn::Sub(middle.to, middle.from));
  const auto last_chord = hn::Sub(last.to, last.from);
  auto nearest = chosen(hn::Gt(middle_chord, first_chord), middle.nearest, first.nearest);
  nearest = chosen(hn::Gt(last_chord, hn::Max(first_chord, middle_chord)), last.nearest, nearest);
  auto distance = scalar_product(normal, nearest);
  distance = chosen(hn::Gt(distance, one), one, hn::Max(distance, splat(-1.0)));
  for (Line* line : {&first, &middle, &last}) line->set_offset(normal);

  // The arc leads from one of the sides at the first corner to the other.
  const Turns ends = product({first.offset, first.half}, {last.offset, last.half});
  const auto turn = scalar_product(normal, vector_product(last.along, first.along));
  const Turns arc = product({scalar_product(last.along, first.along), chosen(inside, negated(turn), turn)},
                            {ends.real, negated(ends.imaginary)});
  auto angle = arguments(arc);
  angle = chosen(hn::And(inside, hn::Lt(angle, zero)), hn::Add(splat(2 * std::numbers::pi), angle), angle);
  const auto disc = hn::Mul(hn::Sub(one, distance), hn::Add(one, distance));
  const auto chords = hn::Add(hn::Add(hn::Mul(first.offset, first_chord), hn::Mul(middle.offset, middle_chord)),
                              hn::Mul(last.offset, last_chord));
  store(hn::Mul(splat(0.5), hn::Add(chords, hn::Mul(disc, angle))), clipped.area[i]);
  store(distance, clipped.distance[i]);

  const auto at_first = sum(first.nearest, scaled(first.along, hn::Mul(sign, first.half)));
  const auto at_last = difference(last.nearest, scaled(last.along, hn::Mul(sign, last.half)));
  const auto from = chosen(inside, at_first, at_last);
  const auto to = chosen(inside, at_last, at_first);
  const auto from_pole = half_areas(load_rows(d, cut.poles, i), from, to);
  store(from_pole.real, clipped.real_from_pole[i]);
  store(from_pole.imaginary, clipped.imaginary_from_pole[i]);
  const auto side = chosen(hn::Lt(distance, zero), splat(-1.0), one);
  const auto pole = scaled(normal, side);
  store(hn::Mul(hn::Mul(side, angle), hn::Sub(one, hn::Mul(side, distance))), clipped.turn[i]);
  const auto factor = half_areas(pole, from, to);
  store(factor.real, clipped.real[i]);
  store(negated(factor.imaginary), clipped.imaginary[i]);
  store_rows(from, clipped.from, i);
  store_rows(to, clipped.to, i);

  // See `ClippedTriangle::angle_of_arc`.
  const auto is_clear = hn::Gt(hn::Abs(arc.imaginary), hn::Mul(splat(kClearTurn), arc.real));
  const auto is_simple = hn::Or(hn::And(inside, hn::AndNot(may_dip(b, c), is_clear)),
                                hn::AndNot(inside, hn::And(hn::Ge(angle, zero), hn::Gt(middle.square, zero))));
  const auto has_area = hn::And(hn::Gt(size, zero), hn::Gt(hn::Mul(first.square, last.square), zero));
  const auto short_square = hn::Mul(splat(kNeedle), hn::Max(first.square, last.square));
  const auto is_needle = hn::Or(hn::Lt(middle.square, short_square),
                                hn::Or(hn::Lt(first.square, short_square), hn::Lt(last.square, short_square)));
  const auto is_short = hn::Lt(angle, splat(kLongArc));
  return bits_of(d,
                 hn::And(hn::And(is_simple, corners.are_near()), hn::AndNot(is_needle, hn::And(has_area, is_short))));
}

LaneMask measure(const CutTriangles& cut, std::size_t count, ClippedTriangles& clipped) {
  LaneMask measured = 0;
  for (std::size_t i = 0; i < count; i += kLanes<Doubles>) measured |= measure_vector(cut, i, clipped) << i;
  return measured & first_lanes(static_cast<unsigned>(count));
}

void add_whole(const WholeTriangles& triangles, QueryWord queries, const PointPerLane<double>& centers, double scale,
               WholeSums& sums) {
  const Doubles d;
  const auto area = splat(triangles.area);
  const auto moment = splat(triangles.moment);
  const auto vector = splat_point(d, triangles.vector);
  const auto point = splat_point(d, triangles.point);
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    if ((queries >> i & first_lanes(kLanes<Doubles>)) == 0) continue;
    const Lanes chosen = mask_of(d, queries >> i);
    const auto offset = scaled(difference(point, load_rows(d, centers, i)), splat(scale));
    add_to(sums.area[i], only(d, chosen, area));
    add_to(sums.moment[i], only(d, chosen, hn::Add(moment, scalar_product(vector, offset))));
  }
}

LaneMask may_dip_of(const CutTriangles& cut, std::size_t count) {
  const Doubles d;
  LaneMask result = 0;
  for (std::size_t i = 0; i < count; i += kLanes<Doubles>) {
    const Corners corners(cut, i);
    const Lanes inside = hn::Gt(load(cut.insides[i]), hn::Zero(d));
    const Lanes is_clear = hn::AndNot(may_dip(corners.b, corners.c), corners.are_near());
    result |= bits_of(d, hn::AndNot(is_clear, inside)) << i;
  }
  return result & first_lanes(static_cast<unsigned>(count));
}

/// No point of a triangle is nearer than its corners are along any direction. Of small triangles, that to a corner
/// tells nearly the most.
QueryWord may_reach(const std::array<Point, 3>& corners, QueryWord queries, const PointPerLane<double>& centers,
                    const PerLane<double>& squared_reaches) {
  const Doubles d;
  QueryWord beyond = 0;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    if ((queries >> i & first_lanes(kLanes<Doubles>)) == 0) continue;
    const auto center = load_rows(d, centers, i);
    const auto a = difference(splat_point(d, corners[0]), center);
    const auto b = difference(splat_point(d, corners[1]), center);
    const auto c = difference(splat_point(d, corners[2]), center);
    const auto square = squared_length(a);
    const auto least = hn::Min(square, hn::Min(scalar_product(a, b), scalar_product(a, c)));
    const auto limit = hn::Mul(load(squared_reaches[i]), square);
    beyond |= bits_of(d, hn::And(hn::Gt(least, hn::Zero(d)), hn::Gt(hn::Mul(least, least), limit))) << i;
  }
  return queries & ~beyond;
}

constexpr PatchKernels kPatchKernels{add_whole, measure, may_dip_of, may_reach};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::PatchKernels& meshhood::patch_kernels(Isa isa) { return MESHHOOD_TABLE(kPatchKernels, isa); }
#endif
