// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <array>
#include <cstddef>
#include <cstdint>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2,popcnt")))

namespace meshhood {
namespace {

/// Bit `i` is set if number `i` is > `limit`.
MESHHOOD_MOMENTS inline QueryWord greater(const Sixteen& numbers, float limit) {
  return _mm512_cmp_ps_mask(reinterpret_cast<const __m512&>(numbers), _mm512_set1_ps(limit), _CMP_GT_OQ);
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {
namespace {

/// The powers of degree 2 and less: eight, and two.
struct SmallPowers {
  __m512d low;
  __m512d high;
};

/// The numbers of `powers` that `places` names.
MESHHOOD_MOMENTS inline __m512d chosen(const SmallPowers& powers, __m512i places) {
  return _mm512_permutex2var_pd(powers.low, places, powers.high);
}

using FactorColumn = std::array<std::uint64_t, PaddedMoments::kPadded>;
constexpr FactorColumn column(std::size_t Factors::* factor) {
  FactorColumn places{};
  for (std::size_t m = 0; m < places.size(); ++m) places[m] = kFactors[m].*factor;
  return places;
}
alignas(64) constexpr FactorColumn kFirstFactors = column(&Factors::first);
alignas(64) constexpr FactorColumn kSecondFactors = column(&Factors::second);

/// As `powers_of`, by permutations: each power is a product of two of the ten small ones.
MESHHOOD_MOMENTS inline void permuted_powers(const MomentPoints& points, std::size_t i, PaddedMoments& out) {
  const __m512d one = _mm512_set1_pd(1);
  const __m512d x = _mm512_set1_pd(points.x[i]);
  const __m512d y = _mm512_set1_pd(points.y[i]);
  const __m512d z = _mm512_set1_pd(points.z[i]);
  // 1 x y z xx xy xz yy, and yz zz: products of two coordinates.
  const __m512d left = _mm512_mask_mov_pd(_mm512_mask_mov_pd(x, 0b1000'0100, y), 0b0000'1000, z);
  const __m512d right = _mm512_mask_mov_pd(_mm512_mask_mov_pd(x, 0b1010'0000, y), 0b0100'0000, z);
  const SmallPowers small{
      _mm512_mul_pd(_mm512_mask_mov_pd(left, 0b0000'0001, one), _mm512_mask_mov_pd(right, 0b0000'1111, one)),
      _mm512_mul_pd(_mm512_mask_mov_pd(z, 0b0000'0001, y), z)};
  const __m512d weight = _mm512_set1_pd(points.weight[i]);
  const SmallPowers weighted{_mm512_mul_pd(weight, small.low), _mm512_mul_pd(weight, small.high)};
#pragma GCC unroll 5
  for (std::size_t m = 0; m < PaddedMoments::kPadded; m += kEight) {
    _mm512_store_pd(&out.at[m], _mm512_mul_pd(chosen(weighted, _mm512_load_si512(&kFirstFactors[m])),
                                              chosen(small, _mm512_load_si512(&kSecondFactors[m]))));
  }
}

MESHHOOD_MOMENTS inline void append_chosen(__mmask16 chosen, __m512i places, __m512i words, VertexList& list) {
  _mm512_storeu_si512(&list.places[list.size], _mm512_maskz_compress_epi32(chosen, places));
  _mm512_storeu_si512(&list.words[list.size], _mm512_maskz_compress_epi32(chosen, words));
  list.size += static_cast<std::size_t>(_mm_popcnt_u32(chosen));
}

MESHHOOD_MOMENTS void append_by_masks(std::uint32_t first, std::span<const QueryWord> words, QueryWord all,
                                      VertexList& common, VertexList& some) {
  const __m512i counting = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (std::size_t i = 0; i < words.size(); i += kSixteen) {
    const auto valid = static_cast<__mmask16>(_bzhi_u32(0xFFFF, static_cast<unsigned>(words.size() - i)));
    const __m512i word = _mm512_maskz_loadu_epi32(valid, &words[i]);
    const __m512i place = _mm512_add_epi32(counting, _mm512_set1_epi32(static_cast<int>(first + i)));
    const __mmask16 is_common = _mm512_mask_cmpeq_epi32_mask(valid, word, _mm512_set1_epi32(static_cast<int>(all)));
    const __mmask16 is_some = _mm512_test_epi32_mask(word, word) & static_cast<__mmask16>(~is_common);
    append_chosen(is_common, place, word, common);
    append_chosen(is_some, place, word, some);
  }
}

constexpr MomentKernels kAvx512Kernels = [] {
  MomentKernels kernels = kMomentKernels;
  kernels.add_powers_by_word = add_powers_by_word<permuted_powers>;
  kernels.append = append_by_masks;
  return kernels;
}();

}  // namespace

const MomentKernels& avx512_moment_kernels() { return kAvx512Kernels; }

}  // namespace meshhood
#endif
