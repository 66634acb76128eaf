// SPDX-License-Identifier: MIT
// Compiles the source that includes this once for each target, and has what the kernels share. The source defines
// HWY_TARGET_INCLUDE, its own path, before. A row of 32 lanes is a few vectors: the tags below have at most as many
// lanes as the kernels can use, and the constants say how many.
#include <array>
#include <cstddef>
#include <cstdint>

#include "simd/leaf.h"
#include "simd/target_list.h"

// clang-format off: the order matters.
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "simd/wasm_doubles-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of at most 64 bytes.
template <class T>
using Tag = hn::CappedTag<T, 64 / sizeof(T)>;
using Words = Tag<std::uint32_t>;
using Floats = Tag<float>;
using Doubles = Tag<double>;
using Ids = hn::Rebind<VertexId, Words>;
template <class D>
using VectorOf = hn::Vec<D>;
using Numbers = VectorOf<Doubles>;
using Word = VectorOf<Words>;

template <class D>
constexpr std::size_t kLanes = hn::MaxLanes(D());

/// Loads the numbers from `first` on, which is aligned to a vector.
template <class T>
HWY_INLINE VectorOf<Tag<T>> load(const T& first) {
  return hn::Load(Tag<T>(), &first);
}
template <class T>
HWY_INLINE void store(VectorOf<Tag<T>> numbers, T& first) {
  hn::Store(numbers, Tag<T>(), &first);
}
template <class T>
HWY_INLINE void add_to(T& first, VectorOf<Tag<T>> numbers) {
  store(hn::Add(load(first), numbers), first);
}

template <class T>
HWY_INLINE VectorOf<Tag<T>> splat(T number) {
  return hn::Set(Tag<T>(), number);
}

/// The number of vectors that hold a row of 32 lanes.
template <class D>
constexpr std::size_t kVectors = kLeafCapacity / kLanes<D>;

/// Whether vectors have at most 128 bits. Where few of the 32 lanes matter, a loop over these is then as fast.
constexpr bool kNarrow = kLanes<Words> <= 4;

/// Returns the bits of the lanes of a row from `first` on.
template <class D>
HWY_INLINE VectorOf<hn::RebindToUnsigned<D>> lane_bits(D /*d*/, std::size_t first) {
  const hn::RebindToUnsigned<D> words;
  return hn::Load(words, &kLaneBits<hn::TFromD<decltype(words)>>[first]);
}

// For vectors of one lane, Highway chooses by a branch, and compilers do not vectorize loops with branches.

/// Returns `yes` in the lanes of the mask, and `no` in the others.
template <class D>
HWY_INLINE VectorOf<D> either([[maybe_unused]] D d, hn::Mask<D> mask, VectorOf<D> yes, VectorOf<D> no) {
#if HWY_TARGET == HWY_SCALAR
  const auto lanes = hn::VecFromMask(d, mask);
  return hn::Or(hn::And(lanes, yes), hn::AndNot(lanes, no));
#else
  return hn::IfThenElse(mask, yes, no);
#endif
}

/// Returns `yes` in the lanes of the mask, and 0 in the others.
template <class D>
HWY_INLINE VectorOf<D> only([[maybe_unused]] D d, hn::Mask<D> mask, VectorOf<D> yes) {
#if HWY_TARGET == HWY_SCALAR
  return hn::And(hn::VecFromMask(d, mask), yes);
#else
  return hn::IfThenElseZero(mask, yes);
#endif
}

/// Returns the union of the words of all lanes.
template <class D>
HWY_INLINE QueryWord any_of([[maybe_unused]] D d, VectorOf<D> words) {
#if HWY_TARGET == HWY_SCALAR
  return static_cast<QueryWord>(hn::GetLane(words));
#else
  if constexpr (kLanes<D> == 2) {
    return static_cast<QueryWord>(hn::ExtractLane(words, 0) | hn::ExtractLane(words, 1));
  } else {
    const hn::Half<D> half;
    return any_of(half, hn::Or(hn::LowerHalf(half, words), hn::UpperHalf(half, words)));
  }
#endif
}

/// Returns the lanes of the mask as bits.
template <class D>
HWY_INLINE LaneMask bits_of([[maybe_unused]] D d, hn::Mask<D> mask) {
#if HWY_TARGET == HWY_AVX3
  return mask.raw;
#elif HWY_TARGET == HWY_AVX2
  const auto lanes = hn::VecFromMask(d, mask);
  if constexpr (kLanes<D> == 4) return static_cast<LaneMask>(_mm256_movemask_pd(hn::BitCast(Doubles(), lanes).raw));
  return static_cast<LaneMask>(_mm256_movemask_ps(hn::BitCast(Floats(), lanes).raw));
#elif HWY_TARGET == HWY_SSE4
  const auto lanes = hn::VecFromMask(d, mask);
  if constexpr (kLanes<D> == 2) return static_cast<LaneMask>(_mm_movemask_pd(hn::BitCast(Doubles(), lanes).raw));
  return static_cast<LaneMask>(_mm_movemask_ps(hn::BitCast(Floats(), lanes).raw));
#elif HWY_TARGET == HWY_WASM
  if constexpr (kLanes<D> == 4) return wasm_i32x4_bitmask(mask.raw);
  return wasm_i64x2_bitmask(mask.raw);
#else
  const hn::RebindToUnsigned<D> words;
  return any_of(words, only(words, hn::RebindMask(words, mask), lane_bits(d, 0)));
#endif
}

/// A mask for each vector of a row.
template <class D>
using MasksOfRow = hn::Mask<D>[kVectors<D>];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment

/// Returns the lanes of a row as bits.
template <class D>
HWY_INLINE LaneMask bits_of_row([[maybe_unused]] D d, const MasksOfRow<D>& masks) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  LaneMask bits = 0;
  for (std::size_t i = 0; i < kVectors<D>; ++i) bits |= bits_of(d, masks[i]) << (i * kLanes<D>);
  return bits;
#elif HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_WASM
  const hn::CappedTag<std::int16_t, 8> shorts;
  const auto joined = [shorts](hn::Mask<D> low, hn::Mask<D> high) HWY_ATTR {
    const hn::RebindToSigned<D> words;
    return hn::ReorderDemote2To(shorts, hn::VecFromMask(words, hn::RebindMask(words, low)),
                                hn::VecFromMask(words, hn::RebindMask(words, high)));
  };
  LaneMask bits = 0;
  for (std::size_t i = 0; i < kVectors<D>; i += 4) {
    const auto low = joined(masks[i], masks[i + 1]).raw;
    const auto high = joined(masks[i + 2], masks[i + 3]).raw;
#if HWY_TARGET == HWY_SSE4
    bits |= static_cast<LaneMask>(_mm_movemask_epi8(_mm_packs_epi16(low, high))) << (4 * i);
#else
    bits |= static_cast<LaneMask>(wasm_i8x16_bitmask(wasm_i8x16_narrow_i16x8(low, high))) << (4 * i);
#endif
  }
  return bits;
#else
  const hn::RebindToUnsigned<D> words;
  auto bits = hn::Zero(words);
  for (std::size_t i = 0; i < kVectors<D>; ++i) {
    bits = hn::Or(bits, only(words, hn::RebindMask(words, masks[i]), lane_bits(d, i * kLanes<D>)));
  }
  return any_of(words, bits);
#endif
}

/// Returns the lanes whose bits are set; bits beyond the lanes have no effect.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, LaneMask bits) {
#if HWY_TARGET == HWY_AVX3
  return hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits));
#else
  const hn::RebindToUnsigned<D> words;
  const auto bits_of_lanes = hn::Set(words, static_cast<hn::TFromD<decltype(words)>>(bits));
  return hn::RebindMask(d, hn::TestBit(bits_of_lanes, lane_bits(d, 0)));
#endif
}

template <class D>
struct Points {
  VectorOf<D> x;
  VectorOf<D> y;
  VectorOf<D> z;
};

/// Loads the vertices from `xyz` on, #V by 3.
template <class D>
HWY_INLINE Points<D> load_points(D d, const hn::TFromD<D>* xyz) {
  Points<D> points;
  hn::LoadInterleaved3(d, xyz, points.x, points.y, points.z);
  return points;
}

/// Loads vertices of floats as doubles.
HWY_INLINE Points<Doubles> load_points(Doubles d, const float* xyz) {
  const auto [x, y, z] = load_points(hn::Rebind<float, Doubles>(), xyz);
  return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
}

/// Loads the points from `first` on of a structure that has a row for each coordinate.
template <class D, class Rows>
HWY_INLINE Points<D> load_rows(D d, const Rows& rows, std::size_t first) {
  return {hn::Load(d, &rows.x[first]), hn::Load(d, &rows.y[first]), hn::Load(d, &rows.z[first])};
}

template <class D, class Rows>
HWY_INLINE void store_rows(const Points<D>& points, Rows& rows, std::size_t first) {
  store(points.x, rows.x[first]);
  store(points.y, rows.y[first]);
  store(points.z, rows.z[first]);
}

template <class D, class P>
HWY_INLINE Points<D> splat_point(D d, const P& p) {
  return {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z)};
}

template <class D>
HWY_INLINE Points<D> difference(const Points<D>& a, const Points<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class D>
HWY_INLINE Points<D> scaled(const Points<D>& points, VectorOf<D> by) {
  return {hn::Mul(points.x, by), hn::Mul(points.y, by), hn::Mul(points.z, by)};
}

template <class D>
HWY_INLINE VectorOf<D> scalar_product(const Points<D>& a, const Points<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// Rounds as `squared_distance` in shared/distance.h.
template <class D>
HWY_INLINE VectorOf<D> squared_length(const Points<D>& points) {
  return scalar_product(points, points);
}

#if HWY_TARGET != HWY_SCALAR
/// Returns a vector that begins with the words whose bits are set, in order.
template <class D>
HWY_INLINE VectorOf<D> compressed([[maybe_unused]] D d, VectorOf<D> words, LaneMask bits) {
#if HWY_TARGET == HWY_AVX3
  return hn::Compress(words, mask_of(d, bits));
#elif HWY_TARGET == HWY_AVX2
  // Before each use, g++ 12 copies the tables of `hn::Compress` to the stack.
  const hn::Rebind<std::uint8_t, D> bytes;
  const auto places = hn::PromoteTo(d, hn::LoadU(bytes, kBitPositions[bits].data()));
  return hn::TableLookupLanes(words, hn::IndicesFromVec(d, places));
#else
  const hn::Repartition<std::uint8_t, D> bytes;
  const auto places = hn::Load(bytes, kBytePlaces[bits].data());
#if HWY_TARGET == HWY_WASM
  return VectorOf<D>{wasm_i8x16_swizzle(words.raw, places.raw)};  // Highway would look up one byte after another
#else
  return hn::BitCast(d, hn::TableLookupBytes(words, places));
#endif
#endif
}
#endif

/// Writes those of the numbers whose bits are set, and returns the end. May write a whole vector.
template <class D>
HWY_INLINE hn::TFromD<D>* write_chosen(D d, VectorOf<D> numbers, LaneMask bits, hn::TFromD<D>* out) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    // The numbers are compressed in a register, because compressing stores are slow on some processors.
    bits &= first_lanes(kLanes<D>);
    hn::StoreU(compressed(d, numbers, bits), d, out);
    return out + hwy::PopCount(bits);
  }
#endif
  std::array<hn::TFromD<D>, kLanes<D>> each;
  hn::StoreU(numbers, d, each.data());
  for (const auto number : each) {
    *out = number;
    out += bits & 1U;
    bits >>= 1;
  }
  return out;
}

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
