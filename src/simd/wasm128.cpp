// SPDX-License-Identifier: MIT
#if defined(__wasm_simd128__)  // elsewhere an empty unit, without headers too
#include "simd/wasm128.h"
#endif

#if defined(MESHHOOD_HAS_WASM128)
#include <wasm_simd128.h>

namespace meshhood {
namespace {

v128_t load2(const double* values) { return wasm_v128_load(values); }
v128_t load2(const float* values) { return wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(values)); }

/// The predicate for two vertices of `xyz`, #V by 3.
template <class Real>
LaneMask within2(const Real* xyz, const LeafBall& ball) {
  const v128_t a = load2(xyz);      // x0 y0
  const v128_t b = load2(xyz + 2);  // z0 x1
  const v128_t c = load2(xyz + 4);  // y1 z1
  const v128_t dx = wasm_f64x2_sub(wasm_i64x2_shuffle(a, b, 0, 3), wasm_f64x2_splat(ball.center.x));
  const v128_t dy = wasm_f64x2_sub(wasm_i64x2_shuffle(a, c, 1, 2), wasm_f64x2_splat(ball.center.y));
  const v128_t dz = wasm_f64x2_sub(wasm_i64x2_shuffle(b, c, 0, 3), wasm_f64x2_splat(ball.center.z));
  const v128_t square =
      wasm_f64x2_add(wasm_f64x2_add(wasm_f64x2_mul(dx, dx), wasm_f64x2_mul(dy, dy)), wasm_f64x2_mul(dz, dz));
  return wasm_i64x2_bitmask(wasm_f64x2_le(square, wasm_f64x2_splat(ball.squared_radius)));
}

template <class Real>
LaneMask within(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; i += 2) result |= within2(xyz + 3 * i, ball) << i;
  return result & first_lanes(static_cast<unsigned>(size));
}

/// Four nodes of a group, from `first` on. The steps are those of the portable kernel.
GroupContainment classify_half(const Group& group, const TreeBall& ball, unsigned first) {
  const auto load = [first](const Group::Row& row) { return wasm_v128_load(row.data() + first); };
  const v128_t x = wasm_f32x4_sub(wasm_f32x4_splat(ball.x), load(group.x));
  const v128_t y = wasm_f32x4_sub(wasm_f32x4_splat(ball.y), load(group.y));
  const v128_t z = wasm_f32x4_sub(wasm_f32x4_splat(ball.z), load(group.z));
  const v128_t square =
      wasm_f32x4_add(wasm_f32x4_add(wasm_f32x4_mul(x, x), wasm_f32x4_mul(y, y)), wasm_f32x4_mul(z, z));
  const v128_t far = wasm_f32x4_add(wasm_f32x4_splat(ball.outer), load(group.radius));
  const v128_t near = wasm_f32x4_sub(wasm_f32x4_splat(ball.inner), load(group.radius));
  const v128_t outside = wasm_f32x4_gt(square, wasm_f32x4_mul(far, far));
  const v128_t inside =
      wasm_v128_and(wasm_f32x4_gt(near, wasm_f32x4_splat(0)), wasm_f32x4_lt(square, wasm_f32x4_mul(near, near)));
  const auto bits = [](v128_t mask) { return static_cast<std::uint8_t>(wasm_i32x4_bitmask(mask)); };
  return {bits(inside), bits(wasm_v128_not(wasm_v128_or(outside, inside)))};
}

GroupContainment classify_group(const Group& group, const TreeBall& ball) {
  const GroupContainment low = classify_half(group, ball, 0);
  const GroupContainment high = classify_half(group, ball, kFanOut / 2);
  const auto join = [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b << kFanOut / 2); };
  return {join(low.inside, high.inside), join(low.intersecting, high.intersecting)};
}

void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball, GroupContainment* out) {
  for (const std::uint32_t group : list) *out++ = classify_group(groups[group], ball);
}

}  // namespace

const Kernels& wasm128_kernels() {
  static const Kernels kAll = [] {
    Kernels all = portable_kernels();
    all.within_float = within<float>;
    all.within_double = within<double>;
    all.classify = classify;
    return all;
  }();
  return kAll;
}

}  // namespace meshhood

#endif
