// SPDX-License-Identifier: MIT
// `PatchKernels` is compiled once for each target; see lanes-inl.h. The formulas are those of `ClippedTriangle` and
// `RimArcs` for the one arc of a triangle of which no corner is far.
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

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

HWY_INLINE Numbers squared_size(const Turns& a) {
  return hn::Add(hn::Mul(a.real, a.real), hn::Mul(a.imaginary, a.imaginary));
}

/// Computes `argument` of numbers that are not 0 and whose imaginary part is not negative.
HWY_INLINE Numbers arguments(const Turns& numbers) {
  const auto zero = hn::Zero(Doubles());
  const auto half_pi = splat(std::numbers::pi / 2);
  const auto x = hn::Abs(numbers.real);
  const auto y = numbers.imaginary;
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
  return chosen(hn::Lt(numbers.real, zero), hn::Sub(splat(std::numbers::pi), quarter), quarter);
}

/// Computes `half_area` of src/patch/sums.cpp.
HWY_INLINE Turns half_areas(const Vectors& n, const Vectors& u, const Vectors& w) {
  const auto products =
      hn::Add(hn::Add(hn::Add(splat(1.0), scalar_product(n, u)), scalar_product(u, w)), scalar_product(w, n));
  return {products, scalar_product(n, vector_product(u, w))};
}

/// A side with one end in the ball.
struct Line {
  /// `side` is the vector from `inside` to the end outside, times `sign`, 1 or -1.
  HWY_INLINE Line(const Vectors& inside, const Vectors& side, Numbers sign) {
    square = squared_length(side);
    unit = hn::Div(sign, hn::Sqrt(square));
    along = scaled(side, unit);
    const auto end = hn::Mul(scalar_product(inside, side), unit);
    nearest = difference(inside, scaled(along, end));
    half = hn::Sqrt(hn::Max(hn::Zero(Doubles()), hn::Sub(splat(1.0), squared_length(nearest))));
    exit = sum(nearest, scaled(along, half));
    chord = hn::Sub(half, end);
  }

  Numbers square;   // of the length of the side
  Numbers unit;     // sign / length
  Vectors nearest;  // to the center
  Vectors along;    // a unit vector, outward
  Numbers half;     // of the chord of the line
  Vectors exit;     // where it leaves the ball
  Numbers chord;    // of the side
};

/// Computes `ClippedTriangle::may_dip`.
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

#if HWY_TARGET != HWY_SCALAR
/// Loads two numbers of every second lane, from number `at` of a row on.
template <class D>
HWY_INLINE VectorOf<D> pairs(D d, const LaneRow* const* lanes, std::size_t row, std::size_t at) {
  if constexpr (kLanes<D> == 2) {
    return hn::LoadU(d, &lanes[0][row][at]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, pairs(half, lanes + kLanes<D> / 2, row, at), pairs(half, lanes, row, at));
  }
}
#endif

/// Loads a row of each lane, by the numbers in it.
struct LaneRows {
  HWY_INLINE LaneRows(const LaneRow* const* lanes, std::size_t row) {
    const Doubles d;
#if HWY_TARGET == HWY_SCALAR
    const auto [x, y, z, w] = lanes[0][row];
    point = {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
    fourth = hn::Set(d, w);
#else
    const auto even = pairs(d, lanes, row, 0);
    const auto odd = pairs(d, lanes + 1, row, 0);
    const auto even_end = pairs(d, lanes, row, 2);
    const auto odd_end = pairs(d, lanes + 1, row, 2);
    point = {hn::InterleaveLower(d, even, odd), hn::InterleaveUpper(d, even, odd),
             hn::InterleaveLower(d, even_end, odd_end)};
    fourth = hn::InterleaveUpper(d, even_end, odd_end);
#endif
  }

  Vectors point;
  Numbers fourth;
};

/// The corners relative to the center, in units of the radius.
struct Corners {
  HWY_INLINE Corners(const CutTriangles& cut, std::size_t i) {
    const auto [center, unit] = LaneRows(&cut.balls[i], 0);
    a = scaled(difference(LaneRows(&cut.corners[i], 0).point, center), unit);
    b = scaled(difference(LaneRows(&cut.corners[i], 1).point, center), unit);
    c = scaled(difference(LaneRows(&cut.corners[i], 2).point, center), unit);
  }

  HWY_INLINE Lanes are_near() const {
    const auto farthest = hn::Max(squared_length(a), hn::Max(squared_length(b), squared_length(c)));
    return hn::Le(farthest, splat(kFar * kFar));
  }

  Vectors a;
  Vectors b;
  Vectors c;
};

/// The arc of each triangle: a number whose argument is its angle, and where both sides at the first corner leave the
/// ball. If that corner is inside, the arc leads from the first to the last, else back.
struct Arcs {
  PerLane<double> real;
  PerLane<double> imaginary;
  PointPerLane<double> first;
  PointPerLane<double> last;
};

/// Measures the chords of the triangles from `i` on. Returns the triangles that these formulas suit.
HWY_INLINE Lanes measure_chords(const Doubles d, const CutTriangles& cut, std::size_t i, ClippedTriangles& clipped,
                                Arcs& arcs) {
  const auto one = splat(1.0);
  const auto zero = hn::Zero(d);
  const auto [a, b, c] = Corners(cut, i);
  const auto sign = load(cut.insides[i]);
  const Lanes inside = hn::Gt(sign, zero);
  const auto first_side = difference(b, a);
  const auto last_side = difference(c, a);
  const auto first_inside = chosen(inside, a, b);
  const auto last_inside = chosen(inside, a, c);
  const Line first(first_inside, first_side, sign);
  const Line last(last_inside, last_side, sign);
  store_rows(first.exit, arcs.first, i);
  store_rows(last.exit, arcs.last, i);

  const auto area = vector_product(first_side, last_side);
  const auto size = hn::Sqrt(squared_length(area));
  const auto normal = scaled(area, hn::Div(one, size));
  const auto distance = scalar_product(normal, chosen(hn::Gt(last.chord, first.chord), last.nearest, first.nearest));
  store(hn::Min(one, hn::Max(distance, splat(-1.0))), clipped.distance[i]);
  // The offsets say how far the lines are from the foot of the center on the plane: to the right of the first side, and
  // of the last one from its other end. An offset is the same for all points of a line, so it follows from the corner
  // in the ball.
  const auto over_first = vector_product(normal, first_inside);
  const auto over_last = vector_product(normal, last_inside);
  const auto first_offset = hn::Mul(sign, scalar_product(over_first, first.along));
  const auto last_offset = negated(hn::Mul(sign, scalar_product(over_last, last.along)));
  // The sum is twice the area between the foot and the chords. The third side is in the ball as a whole, or not at all.
  const auto between = chosen(inside, zero, scalar_product(over_first, last_inside));
  store(hn::Add(hn::Add(hn::Mul(first_offset, first.chord), between), hn::Mul(last_offset, last.chord)),
        clipped.area[i]);

  // The arc leads from one of the sides at the first corner to the other.
  const Turns ends = product({first_offset, first.half}, {last_offset, last.half});
  const auto turn = negated(hn::Mul(sign, hn::Mul(size, hn::Mul(first.unit, last.unit))));
  const Turns arc =
      product({negated(scalar_product(last.along, first.along)), turn}, {ends.real, negated(ends.imaginary)});
  store(arc.real, arcs.real[i]);
  store(arc.imaginary, arcs.imaginary[i]);

  const auto third_square = squared_length(difference(c, b));
  const auto longest_square = hn::Max(first.square, last.square);
  const auto least_square = hn::Min(third_square, hn::Min(first.square, last.square));
  const auto is_needle = hn::Lt(least_square, hn::Mul(splat(kNeedle), longest_square));
  const auto has_area = hn::And(hn::Gt(size, zero), hn::Gt(least_square, zero));
  // One end of each of these sides is in the ball.
  const auto are_near = hn::Le(longest_square, splat((kFar - 1) * (kFar - 1)));
  const auto does_not_dip = hn::AndNot(hn::And(inside, may_dip(b, c)), are_near);
  return hn::And(does_not_dip, hn::AndNot(is_needle, has_area));
}

/// Adds what the arcs add. Returns the arcs that are short, clear and far from the opposite of the pole.
HWY_INLINE Lanes measure_arcs(const Doubles d, const CutTriangles& cut, const Arcs& arcs, std::size_t i,
                              ClippedTriangles& clipped) {
  const auto zero = hn::Zero(d);
  const auto one = splat(1.0);
  const Turns arc{load(arcs.real[i]), load(arcs.imaginary[i])};
  const auto angle = arguments(arc);
  const auto distance = load(clipped.distance[i]);
  const auto disc = hn::Mul(hn::Sub(one, distance), hn::Add(one, distance));
  store(hn::Mul(splat(0.5), hn::Add(load(clipped.area[i]), hn::Mul(disc, angle))), clipped.area[i]);
  const auto side = chosen(hn::Lt(distance, zero), splat(-1.0), one);
  const auto height = hn::Mul(side, distance);
  store(hn::Mul(hn::Mul(side, angle), hn::Sub(one, height)), clipped.turn[i]);

  // The triangle of the pole n of the arc has two sides of the angle a, cos a = h, and the angle t between them. So
  // half its area is the argument of 1 + tan^2(a / 2) e^(it), and that of (1 + h)^2 + (1 - h)(1 + h) e^(it), whose last
  // term is `arc`.
  const auto above = hn::Add(one, height);
  const Turns about{hn::Add(hn::Mul(above, above), arc.real), negated(hn::Mul(side, arc.imaginary))};
  auto from_pole =
      half_areas(LaneRows(&cut.balls[i], 1).point, load_rows(d, arcs.first, i), load_rows(d, arcs.last, i));
  from_pole.imaginary = hn::Mul(load(cut.insides[i]), from_pole.imaginary);
  const Turns factor = product(about, from_pole);
  store(factor.real, clipped.real[i]);
  store(factor.imaginary, clipped.imaginary[i]);

  // `ClippedTriangle::angle_of_arc` explains this bound.
  const auto least = chosen(hn::Gt(load(cut.insides[i]), zero), hn::Mul(splat(kClearTurn), arc.real), zero);
  const auto is_clear = hn::And(hn::Ge(arc.imaginary, zero), hn::Ge(arc.imaginary, least));
  const auto is_far_from_opposite = hn::Ge(squared_size(from_pole), splat(kClearPole));
  return hn::And(hn::And(is_clear, is_far_from_opposite), hn::Lt(angle, splat(kLongArc)));
}

/// The loops are so short that the processor works on several iterations at once.
LaneMask measure(const CutTriangles& cut, std::size_t count, ClippedTriangles& clipped) {
  constexpr std::size_t kStep = kLanes<Doubles>;
  const Doubles d;
  Arcs arcs;
  LaneMask plain = 0;
  LaneMask measured = 0;
  for (std::size_t i = 0; i < count; i += kStep) plain |= bits_of(d, measure_chords(d, cut, i, clipped, arcs)) << i;
  for (std::size_t i = 0; i < count; i += kStep) measured |= bits_of(d, measure_arcs(d, cut, arcs, i, clipped)) << i;
  return plain & measured & first_lanes(static_cast<unsigned>(count));
}

void add_whole(std::span<const WholeTriangles> triangles, const PointPerLane<double>& centers, double scale,
               WholeSums& sums) {
  const Doubles d;
  QueryWord queries = 0;
  for (const WholeTriangles& one : triangles) queries |= one.queries;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    if ((queries >> i & first_lanes(kLanes<Doubles>)) == 0) continue;
    const auto center = load_rows(d, centers, i);
    auto area = hn::Zero(d);
    auto moment = hn::Zero(d);
    for (const WholeTriangles& one : triangles) {
      const Lanes chosen = mask_of(d, one.queries >> i);
      const auto offset = scaled(difference(splat_point(d, one.point), center), splat(scale));
      const auto from_center = hn::Add(splat(one.moment), scalar_product(splat_point(d, one.vector), offset));
      area = hn::Add(area, only(d, chosen, splat(one.area)));
      moment = hn::Add(moment, only(d, chosen, from_center));
    }
    add_to(sums.area[i], area);
    add_to(sums.moment[i], moment);
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

/// No point of a triangle is nearer than its corners are along any direction. For small triangles, the direction to a
/// corner decides nearly as often as the best one.
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
