// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#if defined(MESHHOOD_HAS_X86)
// g++ 12 warns about values that its own intrinsics leave undefined on purpose.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <algorithm>
#include <bit>
#include <limits>

#include <immintrin.h>

#define MESHHOOD_AVX512 __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq,bmi2")))

namespace meshhood {
namespace {

MESHHOOD_AVX512 inline __m512d load8(const float* values) { return _mm512_cvtps_pd(_mm256_loadu_ps(values)); }
MESHHOOD_AVX512 inline __m512d load8(const double* values) { return _mm512_loadu_pd(values); }

struct Points8 {
  __m512d x;
  __m512d y;
  __m512d z;
};

/// Eight vertices of `xyz`, #V by 3.
template <class Real>
MESHHOOD_AVX512 inline Points8 load_points8(const Real* xyz) {
  const __m512d a = load8(xyz);
  const __m512d b = load8(xyz + 8);
  const __m512d c = load8(xyz + 16);
  // Indices from 8 on select from `b`. The values of `c` are inserted afterwards.
  const __m512d x = _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), b);
  const __m512d y = _mm512_permutex2var_pd(a, _mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), b);
  const __m512d z = _mm512_permutex2var_pd(a, _mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), b);
  return {_mm512_mask_permutexvar_pd(x, 0xC0, _mm512_setr_epi64(0, 0, 0, 0, 0, 0, 2, 5), c),
          _mm512_mask_permutexvar_pd(y, 0xE0, _mm512_setr_epi64(0, 0, 0, 0, 0, 0, 3, 6), c),
          _mm512_mask_permutexvar_pd(z, 0xE0, _mm512_setr_epi64(0, 0, 0, 0, 0, 1, 4, 7), c)};
}

/// The predicate for eight vertices.
template <class Real>
MESHHOOD_AVX512 inline LaneMask within8(const Real* xyz, const LeafBall& ball) {
  const Points8 points = load_points8(xyz);
  const __m512d dx = _mm512_sub_pd(points.x, _mm512_set1_pd(ball.center.x));
  const __m512d dy = _mm512_sub_pd(points.y, _mm512_set1_pd(ball.center.y));
  const __m512d dz = _mm512_sub_pd(points.z, _mm512_set1_pd(ball.center.z));
  const __m512d square =
      _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
  return _mm512_cmp_pd_mask(square, _mm512_set1_pd(ball.squared_radius), _CMP_LE_OQ);
}

template <class Real>
MESHHOOD_AVX512 LaneMask within_exact(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; i += 8) {
    result |= within8(xyz + 3 * i, ball) << i;
  }
  return result & first_lanes(static_cast<unsigned>(size));
}

struct Points16 {
  __m512 x;
  __m512 y;
  __m512 z;
};

/// Sixteen vertices of `xyz`, #V by 3.
MESHHOOD_AVX512 inline Points16 load_points16(const float* xyz) {
  const __m512 a = _mm512_loadu_ps(xyz);
  const __m512 b = _mm512_loadu_ps(xyz + 16);
  const __m512 c = _mm512_loadu_ps(xyz + 32);
  const __m512i xs = _mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 1, 4, 7, 10, 13);
  const __m512i ys = _mm512_setr_epi32(1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 2, 5, 8, 11, 14);
  const __m512i zs = _mm512_setr_epi32(2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 0, 3, 6, 9, 12, 15);
  // Indices from 16 on select from `b`. The values of `c` are inserted afterwards.
  return {_mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, xs, b), 0xF800, xs, c),
          _mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, ys, b), 0xF800, ys, c),
          _mm512_mask_permutexvar_ps(_mm512_permutex2var_ps(a, zs, b), 0xFC00, zs, c)};
}

MESHHOOD_AVX512 inline __m512 square16(const float* xyz, const LeafBall& ball) {
  const Points16 points = load_points16(xyz);
  const __m512 dx = _mm512_sub_ps(points.x, _mm512_set1_ps(ball.x));
  const __m512 dy = _mm512_sub_ps(points.y, _mm512_set1_ps(ball.y));
  const __m512 dz = _mm512_sub_ps(points.z, _mm512_set1_ps(ball.z));
  return _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)), _mm512_mul_ps(dz, dz));
}

MESHHOOD_AVX512 LaneMask within_float(const float* xyz, std::size_t size, const LeafBall& ball) {
  const __m512 low = square16(xyz, ball);
  const __m512 high = square16(xyz + 48, ball);
  const __m512 inner = _mm512_set1_ps(ball.surely_inside);
  const __m512 outer = _mm512_set1_ps(ball.surely_outside);
  const LaneMask inside =
      _mm512_cmp_ps_mask(low, inner, _CMP_LE_OQ) | LaneMask{_mm512_cmp_ps_mask(high, inner, _CMP_LE_OQ)} << 16;
  const LaneMask outside =
      _mm512_cmp_ps_mask(low, outer, _CMP_GT_OQ) | LaneMask{_mm512_cmp_ps_mask(high, outer, _CMP_GT_OQ)} << 16;
  const LaneMask all = first_lanes(static_cast<unsigned>(size));
  if (((inside | outside) & all) != all) [[unlikely]] {
    return within_exact(xyz, size, ball);
  }
  return inside & all;
}

MESHHOOD_AVX512 LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  const __m512i one = _mm512_set1_epi32(1);
  const __m512i source = _mm512_set1_epi32(static_cast<int>(from));
  __m512i result = _mm512_setzero_si512();
  for (std::size_t i = 0; i < edges.size(); i += 16) {
    const auto live = static_cast<__mmask16>((1U << std::min<std::size_t>(edges.size() - i, 16)) - 1);
    const __m512i pairs = _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(edges.data() + i)));
    const __m512i start = _mm512_and_si512(pairs, _mm512_set1_epi32(31));
    const __m512i begins = _mm512_and_si512(_mm512_srlv_epi32(source, start), one);
    result = _mm512_mask_or_epi32(result, live, result, _mm512_sllv_epi32(begins, _mm512_srli_epi32(pairs, 8)));
  }
  return static_cast<LaneMask>(_mm512_reduce_or_epi32(result));
}

MESHHOOD_AVX512 LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  const __m512i low = _mm512_loadu_si512(adjacency);
  const __m512i high = _mm512_loadu_si512(adjacency + 16);
  for (LaneMask reached = from;;) {
    const __m512i all = _mm512_set1_epi32(static_cast<int>(reached));
    // The lanes with a neighbor among those reached.
    const LaneMask near = _mm512_test_epi32_mask(low, all) | LaneMask{_mm512_test_epi32_mask(high, all)} << 16;
    const LaneMask grown = reached | (near & among);
    if (grown == reached) return reached;
    reached = grown;
  }
}

MESHHOOD_AVX512 VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  const auto low = static_cast<__mmask16>(lanes);
  const auto high = static_cast<__mmask16>(lanes >> 16);
  // Compresses in a register, because compressing stores are slow on some processors.
  _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(low, _mm512_loadu_si512(ids)));
  out += std::popcount(lanes & 0xFFFFU);
  _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(high, _mm512_loadu_si512(ids + 16)));
  return out + std::popcount(lanes >> 16);
}

}  // namespace

const Kernels& avx512_kernels() {
  // A group has eight floats a row, the width of an AVX2 register.
  static const Kernels all{within_float, within_exact<double>,    cross_edges,
                           reachable,    avx2_kernels().classify, compress};
  return all;
}

}  // namespace meshhood
#endif
