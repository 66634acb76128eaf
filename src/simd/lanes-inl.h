// SPDX-License-Identifier: MIT
// What the kernels share, for the target that is being compiled; see targets.cpp. A row of 32 lanes is a few vectors:
// the tags below have at most as many lanes as the kernels can use, and the constants say how many.

HWY_BEFORE_NAMESPACE();
namespace meshhood::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, 16>;
using Floats = hn::CappedTag<float, 16>;
using Doubles = hn::CappedTag<double, 8>;
using Ids = hn::Rebind<VertexId, Words>;
template <class D>
using VectorOf = hn::Vec<D>;

template <class D>
constexpr std::size_t kLanes = hn::MaxLanes(D());

/// The lanes of the mask as bits.
template <class D>
HWY_INLINE LaneMask bits_of(D d, hn::Mask<D> mask) {
#if HWY_TARGET == HWY_AVX2
  if constexpr (kLanes<D> == 8) {
    return static_cast<LaneMask>(_mm256_movemask_ps(hn::BitCast(Floats(), hn::VecFromMask(d, mask)).raw));
  }
#endif
  // As many bytes are read as written: a processor waits if it reads what it has just written in parts.
  using Bits = std::conditional_t<(kLanes<D> > 8), std::uint16_t, std::uint8_t>;
  std::array<std::uint8_t, 8> bytes;  // as many as Highway demands
  hn::StoreMaskBits(d, mask, bytes.data());
  Bits bits;
  std::memcpy(&bits, bytes.data(), sizeof(bits));
  return bits;
}

/// The lanes whose bits are set; bits beyond the lanes have no effect.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, LaneMask bits) {
#if HWY_TARGET == HWY_AVX3
  return hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits));
#else
  const hn::RebindToUnsigned<D> words;
  const auto of_lanes = hn::Set(words, 1) << hn::Iota(words, 0);
  return hn::RebindMask(d, hn::TestBit(hn::Set(words, static_cast<hn::TFromD<decltype(words)> >(bits)), of_lanes));
#endif
}

/// The lanes whose words have one of the bits.
HWY_INLINE LaneMask lanes_with(VectorOf<Words> words, VectorOf<Words> bits) {
#if HWY_TARGET == HWY_AVX3
  return _mm512_test_epi32_mask(words.raw, bits.raw);
#else
  const Words d;
  return bits_of(d, hn::Ne(hn::And(words, bits), hn::Zero(d)));
#endif
}

/// The words of all lanes together.
template <class D>
HWY_INLINE QueryWord any_of([[maybe_unused]] D d, VectorOf<D> words) {
  if constexpr (kLanes<D> == 2) {
    return hn::ExtractLane(words, 0) | hn::ExtractLane(words, 1);
  } else {
    const hn::Half<D> half;
    return any_of(half, hn::Or(hn::LowerHalf(half, words), hn::UpperHalf(half, words)));
  }
}

/// Three coordinates of each lane.
template <class D>
struct Points {
  VectorOf<D> x;
  VectorOf<D> y;
  VectorOf<D> z;
};

/// The vertices from `xyz` on, #V by 3.
template <class D>
HWY_INLINE Points<D> load_points(D d, const hn::TFromD<D>* xyz) {
  Points<D> points;
  hn::LoadInterleaved3(d, xyz, points.x, points.y, points.z);
  return points;
}

#if HWY_TARGET == HWY_AVX3
// Two permutations for each coordinate of 64 bytes; Highway joins blocks of 16 bytes first.

HWY_INLINE Points<Floats> load_points(Floats d, const float* xyz) {
  const __m512 a = hn::LoadU(d, xyz).raw;
  const __m512 b = hn::LoadU(d, xyz + 16).raw;
  const __m512 c = hn::LoadU(d, xyz + 32).raw;
  const __m512i xs = _mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 1, 4, 7, 10, 13);
  const __m512i ys = _mm512_setr_epi32(1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 2, 5, 8, 11, 14);
  const __m512i zs = _mm512_setr_epi32(2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 0, 3, 6, 9, 12, 15);
  // Indices from 16 on select from `b`. The values of `c` are inserted afterwards.
  return {{_mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, xs, b), 0xF800, xs, c)},
          {_mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, ys, b), 0xF800, ys, c)},
          {_mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, zs, b), 0xFC00, zs, c)}};
}

HWY_INLINE Points<Doubles> joined(Doubles /*d*/, __m512d a, __m512d b, __m512d c) {
  const __m512i xs = _mm512_setr_epi64(0, 3, 6, 9, 12, 15, 2, 5);
  const __m512i ys = _mm512_setr_epi64(1, 4, 7, 10, 13, 0, 3, 6);
  const __m512i zs = _mm512_setr_epi64(2, 5, 8, 11, 14, 1, 4, 7);
  return {{_mm512_mask_permutexvar_pd(_mm512_permutex2var_pd(a, xs, b), 0xC0, xs, c)},
          {_mm512_mask_permutexvar_pd(_mm512_permutex2var_pd(a, ys, b), 0xE0, ys, c)},
          {_mm512_mask_permutexvar_pd(_mm512_permutex2var_pd(a, zs, b), 0xE0, zs, c)}};
}

HWY_INLINE Points<Doubles> load_points(Doubles d, const double* xyz) {
  return joined(d, hn::LoadU(d, xyz).raw, hn::LoadU(d, xyz + 8).raw, hn::LoadU(d, xyz + 16).raw);
}

HWY_INLINE Points<Doubles> load_points(Doubles d, const float* xyz) {
  const hn::Rebind<float, Doubles> eight;
  return joined(d, hn::PromoteTo(d, hn::LoadU(eight, xyz)).raw, hn::PromoteTo(d, hn::LoadU(eight, xyz + 8)).raw,
                hn::PromoteTo(d, hn::LoadU(eight, xyz + 16)).raw);
}
#else
/// The same for floats as doubles.
HWY_INLINE Points<Doubles> load_points(Doubles d, const float* xyz) {
  const auto [x, y, z] = load_points(hn::Rebind<float, Doubles>(), xyz);
  return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
}
#endif

/// The squares of the lengths, with the roundings of `squared_distance`.
template <class V>
HWY_INLINE V squared_length(V x, V y, V z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

/// Moves the numbers whose bits are set to the first lanes, in order.
template <class D>
HWY_INLINE VectorOf<D> compressed(D d, VectorOf<D> numbers, LaneMask bits) {
#if HWY_TARGET != HWY_AVX3
  // Before each use, g++ 12 copies the tables of `hn::Compress` to the stack.
  if constexpr (sizeof(hn::TFromD<D>) == 4 && kLanes<D> == 8) {
    const hn::Rebind<std::uint8_t, D> bytes;
    return hn::TableLookupLanes(numbers,
                                hn::IndicesFromVec(d, hn::PromoteTo(d, hn::LoadU(bytes, kBitPositions[bits].data()))));
  } else if constexpr (sizeof(hn::TFromD<D>) == 4) {
    const hn::Repartition<std::uint8_t, D> bytes;
    return hn::BitCast(d, hn::TableLookupBytes(numbers, hn::Load(bytes, kBytePlaces[bits].data())));
  }
#endif
  return hn::Compress(numbers, mask_of(d, bits));
}

/// Writes those of the numbers whose bits are set, and returns the end. May write a whole vector. Compresses in a
/// register, because compressing stores are slow on some processors.
template <class D>
HWY_INLINE hn::TFromD<D>* write_chosen(D d, VectorOf<D> numbers, LaneMask bits, hn::TFromD<D>* out) {
  bits &= first_lanes(kLanes<D>);
  hn::StoreU(compressed(d, numbers, bits), d, out);
  return out + hwy::PopCount(bits);
}

}  // namespace
}  // namespace meshhood::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
