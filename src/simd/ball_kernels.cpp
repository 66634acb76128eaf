// SPDX-License-Identifier: MIT
// `Kernels` is compiled once for each target; see lanes-inl.h.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/kernels.h"
#include "simd/leaf.h"

#define HWY_TARGET_INCLUDE "simd/ball_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

/// Applies the predicate. Calls `f(i, squares)` for the vertices from `i` on.
template <class Real, class F>
HWY_INLINE LaneMask decide(const Real* xyz, std::size_t size, const LeafBall& ball, F&& f) {
  const Doubles d;
  LaneMask inside = 0;
  for (std::size_t i = 0; i < size; i += kLanes<Doubles>) {
    const auto square = squared_length(difference(load_points(d, xyz + 3 * i), splat_point(d, ball.center)));
    f(i, square);
    inside |= bits_of(d, hn::Le(square, hn::Set(d, ball.squared_radius))) << i;
  }
  return inside & first_lanes(static_cast<unsigned>(size));
}

template <class Real>
LaneMask within_exact(const Real* xyz, std::size_t size, const LeafBall& ball) {
  return decide(xyz, size, ball, [](std::size_t, Numbers) HWY_ATTR {});
}

template <class Real>
LaneMask squares(const Real* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out) {
  return decide(xyz, size, ball, [&](std::size_t i, Numbers square) HWY_ATTR { store(square, out[i]); });
}

/// Decides in single precision, if that is possible for all vertices.
LaneMask within_float(const float* xyz, std::size_t size, const LeafBall& ball) {
  const Floats d;
  LaneMask inside = 0;
  LaneMask outside = 0;
  // An unrolled loop over all lanes takes less time than one that stops early, but not in WebAssembly.
  constexpr bool kUnrolled = HWY_TARGET != HWY_WASM && HWY_TARGET != HWY_SCALAR;
  const std::size_t end = kUnrolled ? kLeafCapacity : size;
  for (std::size_t i = 0; i < end; i += kLanes<Floats>) {
    const auto square = squared_length(difference(load_points(d, xyz + 3 * i), splat_point(d, ball)));
    inside |= bits_of(d, hn::Le(square, splat(ball.surely_inside))) << i;
    outside |= bits_of(d, hn::Gt(square, splat(ball.surely_outside))) << i;
  }
  const LaneMask all = first_lanes(static_cast<unsigned>(size));
  if (((inside | outside) & all) != all) [[unlikely]] {
    return within_exact(xyz, size, ball);
  }
  return inside & all;
}

LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  if constexpr (kNarrow) {  // some of these targets cannot shift each lane by another number
    LaneMask result = 0;
    for (const CrossEdge& edge : edges) result |= (from >> edge.from & 1U) << edge.to;
    return result;
  }
  const Words d;
  const hn::Rebind<std::uint16_t, Words> pairs;
  auto result = hn::Zero(d);
  for (std::size_t i = 0; i < edges.size(); i += kLanes<Words>) {
    const auto pair = hn::PromoteTo(d, hn::LoadU(pairs, reinterpret_cast<const std::uint16_t*>(edges.data() + i)));
    const auto begins = hn::And((hn::Set(d, from) >> hn::And(pair, hn::Set(d, 31))), hn::Set(d, 1));
    const auto ends = begins << hn::ShiftRight<8>(pair);
    result = hn::Or(result, hn::IfThenElseZero(hn::FirstN(d, edges.size() - i), ends));
  }
  return any_of(d, result);
}

LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  if constexpr (kNarrow) {
    LaneMask reached = from;
    for (LaneMask todo = from; todo != 0 && reached != among;) {
      const LaneMask added = adjacency[std::countr_zero(todo)] & among & ~reached;
      todo = (todo & (todo - 1)) | added;
      reached |= added;
    }
    return reached;
  }
  const Words d;
  for (LaneMask reached = from;;) {
    LaneMask near = 0;  // the lanes with a neighbor among those reached
    for (std::size_t i = 0; i < kLeafCapacity; i += kLanes<Words>) {
      near |= bits_of(d, hn::Ne(hn::And(hn::LoadU(d, adjacency + i), splat(reached)), hn::Zero(d))) << i;
    }
    const LaneMask grown = reached | (near & among);
    if (grown == reached) return reached;
    reached = grown;
  }
}

HWY_INLINE GroupContainment classify_group(const Group& group, const TreeBall& ball) {
  const hn::CappedTag<float, kFanOut> d;
  unsigned outside = 0;
  unsigned inside = 0;
  for (std::size_t i = 0; i < kFanOut; i += kLanes<decltype(d)>) {
    const auto square = squared_length(difference(splat_point(d, ball), load_rows(d, group, i)));
    const auto radius = hn::Load(d, &group.radius[i]);
    const auto far = hn::Add(hn::Set(d, ball.outer), radius);
    const auto near = hn::Max(hn::Sub(hn::Set(d, ball.inner), radius), hn::Zero(d));
    outside |= bits_of(d, hn::Gt(square, hn::Mul(far, far))) << i;
    inside |= bits_of(d, hn::Lt(square, hn::Mul(near, near))) << i;
  }
  return {static_cast<std::uint8_t>(inside), static_cast<std::uint8_t>(~(outside | inside))};
}

void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball, GroupContainment* out) {
  constexpr std::size_t kAhead = 4;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i + kAhead < list.size()) {
      const auto* const next = reinterpret_cast<const char*>(groups + list[i + kAhead]);
      for (std::size_t line = 0; line < sizeof(Group); line += 64) hwy::Prefetch(next + line);
    }
    out[i] = classify_group(groups[list[i]], ball);
  }
}

unsigned box_squares(const BoxGroup& boxes, const FramePoint& center, float limit, BoxGroup::Row& squares) {
  unsigned near = 0;
  const hn::CappedTag<float, kFanOut> d;
  const auto at = splat_point(d, center);
  const auto outside = [d](auto below, auto above) HWY_ATTR { return hn::Max(hn::Max(below, above), hn::Zero(d)); };
  for (std::size_t i = 0; i < kFanOut; i += kLanes<decltype(d)>) {
    const auto below = difference(load_rows(d, boxes.low, i), at);
    const auto above = difference(at, load_rows(d, boxes.high, i));
    const Points<decltype(d)> gap{outside(below.x, above.x), outside(below.y, above.y), outside(below.z, above.z)};
    const auto square = squared_length(gap);
    hn::StoreU(square, d, &squares[i]);
    near |= bits_of(d, hn::Le(square, hn::Set(d, limit))) << i;
  }
  return near;
}

unsigned box_entries(const BoxGroup& boxes, const BoxRay& ray, float limit, BoxGroup::Row& entries) {
  unsigned met = 0;
  const hn::CappedTag<float, kFanOut> d;
  for (std::size_t i = 0; i < kFanOut; i += kLanes<decltype(d)>) {
    auto entry = hn::Zero(d);
    auto exit = hn::Set(d, limit);
    const auto cross_slab = [&](const BoxRay::Axis& axis, const BoxGroup::Row& low,
                                const BoxGroup::Row& high) HWY_ATTR {
      const auto way_to = [&](const BoxGroup::Row& wall, float begin) HWY_ATTR {
        return hn::Mul(hn::Sub(hn::Load(d, &wall[i]), hn::Set(d, begin)), hn::Set(d, axis.inverse));
      };
      const auto to_low = way_to(low, axis.low);
      const auto to_high = way_to(high, axis.high);
      entry = hn::Max(entry, hn::Min(to_low, to_high));
      exit = hn::Min(exit, hn::Max(to_low, to_high));
    };
    cross_slab(ray.x, boxes.low.x, boxes.high.x);
    cross_slab(ray.y, boxes.low.y, boxes.high.y);
    cross_slab(ray.z, boxes.low.z, boxes.high.z);
    hn::StoreU(entry, d, &entries[i]);
    met |= bits_of(d, hn::Le(entry, hn::Mul(exit, hn::Set(d, kExitSlack)))) << i;
  }
  return met;
}

VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  const Ids d;
  for (std::size_t i = 0; i < kLeafCapacity; i += kLanes<Ids>) {
    out = write_chosen(d, hn::LoadU(d, ids + i), lanes >> i, out);
  }
  return out;
}

void count_less(const double* numbers, std::size_t count, std::uint64_t* less) {
  const Doubles d;
  static_assert(2 * kLanes<Doubles> <= Kernels::kSpareNumbers + 1);
  const hn::RebindToUnsigned<Doubles> words;
  for (std::size_t i = 0; i < count; i += 2 * kLanes<Doubles>) {
    const auto low = hn::LoadU(d, numbers + i);
    const auto high = hn::LoadU(d, numbers + i + kLanes<Doubles>);
    auto low_count = hn::Zero(words);
    auto high_count = hn::Zero(words);
    for (std::size_t k = 0; k < count; ++k) {
      const auto minus_one_if_less = [&, other = hn::Set(d, numbers[k])](Numbers than) HWY_ATTR {
        return hn::BitCast(words, hn::VecFromMask(d, hn::Lt(other, than)));
      };
      low_count = hn::Sub(low_count, minus_one_if_less(low));
      high_count = hn::Sub(high_count, minus_one_if_less(high));
    }
    hn::StoreU(low_count, words, less + i);
    hn::StoreU(high_count, words, less + i + kLanes<Doubles>);
  }
}

constexpr std::size_t kFewNumbers = std::min(32 * kLanes<Doubles>, Kernels::kMostFewNumbers);

constexpr Kernels kBallKernels{
    within_float, within_exact<double>, squares<float>, squares<double>, cross_edges, reachable,
    classify,     box_squares,          box_entries,    compress,        count_less,  kFewNumbers};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::Kernels& meshhood::kernels(Isa isa) { return MESHHOOD_TABLE(kBallKernels, isa); }
#endif
