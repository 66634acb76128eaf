// SPDX-License-Identifier: MIT
// Adds the arithmetic of doubles in WebAssembly that Highway 1.0.3 lacks. Later versions have it.

#if HWY_TARGET == HWY_WASM && !HWY_HAVE_FLOAT64
HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {

using Doubles128 = Vec128<double>;
using DoubleMask128 = Mask128<double>;

HWY_API Doubles128 Set(Full128<double> /*d*/, double value) { return {wasm_f64x2_splat(value)}; }
HWY_API Doubles128 Add(Doubles128 a, Doubles128 b) { return {wasm_f64x2_add(a.raw, b.raw)}; }
HWY_API Doubles128 Sub(Doubles128 a, Doubles128 b) { return {wasm_f64x2_sub(a.raw, b.raw)}; }
HWY_API Doubles128 Mul(Doubles128 a, Doubles128 b) { return {wasm_f64x2_mul(a.raw, b.raw)}; }
HWY_API Doubles128 Div(Doubles128 a, Doubles128 b) { return {wasm_f64x2_div(a.raw, b.raw)}; }
HWY_API Doubles128 Abs(Doubles128 a) { return {wasm_f64x2_abs(a.raw)}; }
HWY_API Doubles128 Max(Doubles128 a, Doubles128 b) { return {wasm_f64x2_max(a.raw, b.raw)}; }
HWY_API Doubles128 Min(Doubles128 a, Doubles128 b) { return {wasm_f64x2_min(a.raw, b.raw)}; }
HWY_API Doubles128 Sqrt(Doubles128 a) { return {wasm_f64x2_sqrt(a.raw)}; }
HWY_API DoubleMask128 Eq(Doubles128 a, Doubles128 b) { return {wasm_f64x2_eq(a.raw, b.raw)}; }
HWY_API DoubleMask128 Lt(Doubles128 a, Doubles128 b) { return {wasm_f64x2_lt(a.raw, b.raw)}; }
HWY_API DoubleMask128 Le(Doubles128 a, Doubles128 b) { return {wasm_f64x2_le(a.raw, b.raw)}; }
HWY_API DoubleMask128 Gt(Doubles128 a, Doubles128 b) { return {wasm_f64x2_gt(a.raw, b.raw)}; }
HWY_API DoubleMask128 Ge(Doubles128 a, Doubles128 b) { return {wasm_f64x2_ge(a.raw, b.raw)}; }
HWY_API Doubles128 InterleaveLower(Full128<double> /*d*/, Doubles128 a, Doubles128 b) {
  return {wasm_i64x2_shuffle(a.raw, b.raw, 0, 2)};
}
HWY_API Doubles128 InterleaveUpper(Full128<double> /*d*/, Doubles128 a, Doubles128 b) {
  return {wasm_i64x2_shuffle(a.raw, b.raw, 1, 3)};
}
HWY_API Doubles128 PromoteTo(Full128<double> /*d*/, Vec128<float, 2> v) {
  return {wasm_f64x2_promote_low_f32x4(v.raw)};
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
