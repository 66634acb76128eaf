// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#if defined(MESHHOOD_HAS_X86)
#include <bit>
#include <limits>

#include <immintrin.h>

#define MESHHOOD_AVX2 __attribute__((target("avx2")))

namespace meshhood {
namespace {

MESHHOOD_AVX2 inline __m256d load4(const float* values) { return _mm256_cvtps_pd(_mm_loadu_ps(values)); }
MESHHOOD_AVX2 inline __m256d load4(const double* values) { return _mm256_loadu_pd(values); }

struct Points4 {
  __m256d x;
  __m256d y;
  __m256d z;
};

/// Four vertices of `xyz`, #V by 3.
template <class Real>
MESHHOOD_AVX2 inline Points4 load_points4(const Real* xyz) {
  const __m256d a = load4(xyz);                                // x0 y0 | z0 x1
  const __m256d b = load4(xyz + 4);                            // y1 z1 | x2 y2
  const __m256d c = load4(xyz + 8);                            // z2 x3 | y3 z3
  const __m256d even = _mm256_blend_pd(a, b, 0b1100);          // x0 y0 | x2 y2
  const __m256d odd = _mm256_blend_pd(b, c, 0b1100);           // y1 z1 | y3 z3
  const __m256d between = _mm256_permute2f128_pd(a, c, 0x21);  // z0 x1 | z2 x3
  return {_mm256_shuffle_pd(even, between, 0b1010), _mm256_shuffle_pd(even, odd, 0b0101),
          _mm256_shuffle_pd(between, odd, 0b1010)};
}

/// The predicate for four vertices.
template <class Real>
MESHHOOD_AVX2 inline LaneMask within4(const Real* xyz, const LeafBall& ball) {
  const Points4 points = load_points4(xyz);
  const __m256d dx = _mm256_sub_pd(points.x, _mm256_set1_pd(ball.center.x));
  const __m256d dy = _mm256_sub_pd(points.y, _mm256_set1_pd(ball.center.y));
  const __m256d dz = _mm256_sub_pd(points.z, _mm256_set1_pd(ball.center.z));
  const __m256d square =
      _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy)), _mm256_mul_pd(dz, dz));
  return static_cast<LaneMask>(
      _mm256_movemask_pd(_mm256_cmp_pd(square, _mm256_set1_pd(ball.squared_radius), _CMP_LE_OQ)));
}

template <class Real>
MESHHOOD_AVX2 LaneMask within_exact(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; i += 4) {
    result |= within4(xyz + 3 * i, ball) << i;
  }
  return result & first_lanes(static_cast<unsigned>(size));
}

/// Four floats from `low`, then four from `high`.
MESHHOOD_AVX2 inline __m256 load_halves(const float* low, const float* high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}

MESHHOOD_AVX2 inline __m256 square8(const float* xyz, const LeafBall& ball) {
  const __m256 a = load_halves(xyz, xyz + 12);                               // x0 y0 z0 x1 | x4 y4 z4 x5
  const __m256 b = load_halves(xyz + 4, xyz + 16);                           // y1 z1 x2 y2 | y5 z5 x6 y6
  const __m256 c = load_halves(xyz + 8, xyz + 20);                           // z2 x3 y3 z3 | z6 x7 y7 z7
  const __m256 upper_xy = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));  // x2 y2 x3 y3 | ...
  const __m256 lower_yz = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));  // y0 z0 y1 z1 | ...
  const __m256 x = _mm256_shuffle_ps(a, upper_xy, _MM_SHUFFLE(2, 0, 3, 0));
  const __m256 y = _mm256_shuffle_ps(lower_yz, upper_xy, _MM_SHUFFLE(3, 1, 2, 0));
  const __m256 z = _mm256_shuffle_ps(lower_yz, c, _MM_SHUFFLE(3, 0, 3, 1));
  const __m256 dx = _mm256_sub_ps(x, _mm256_set1_ps(ball.x));
  const __m256 dy = _mm256_sub_ps(y, _mm256_set1_ps(ball.y));
  const __m256 dz = _mm256_sub_ps(z, _mm256_set1_ps(ball.z));
  return _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)), _mm256_mul_ps(dz, dz));
}

MESHHOOD_AVX2 LaneMask within_float(const float* xyz, std::size_t size, const LeafBall& ball) {
  const __m256 inner = _mm256_set1_ps(ball.surely_inside);
  const __m256 outer = _mm256_set1_ps(ball.surely_outside);
  LaneMask inside = 0;
  LaneMask outside = 0;
  for (std::size_t i = 0; i < kLeafCapacity; i += 8) {
    const __m256 square = square8(xyz + 3 * i, ball);
    inside |= static_cast<LaneMask>(_mm256_movemask_ps(_mm256_cmp_ps(square, inner, _CMP_LE_OQ))) << i;
    outside |= static_cast<LaneMask>(_mm256_movemask_ps(_mm256_cmp_ps(square, outer, _CMP_GT_OQ))) << i;
  }
  const LaneMask all = first_lanes(static_cast<unsigned>(size));
  if (((inside | outside) & all) != all) [[unlikely]] {
    return within_exact(xyz, size, ball);
  }
  return inside & all;
}

MESHHOOD_AVX2 inline unsigned bits(__m256 mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }

MESHHOOD_AVX2 LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  const __m256i one = _mm256_set1_epi32(1);
  const __m256i source = _mm256_set1_epi32(static_cast<int>(from));
  __m256i result = _mm256_setzero_si256();
  for (std::size_t i = 0; i < edges.size(); i += 8) {
    const __m256i pairs = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(edges.data() + i)));
    const __m256i start = _mm256_and_si256(pairs, _mm256_set1_epi32(31));
    const __m256i rank = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i live = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(edges.size() - i)), rank);
    const __m256i begins = _mm256_and_si256(_mm256_and_si256(_mm256_srlv_epi32(source, start), one), live);
    result = _mm256_or_si256(result, _mm256_sllv_epi32(begins, _mm256_srli_epi32(pairs, 8)));
  }
  const __m128i half = _mm_or_si128(_mm256_castsi256_si128(result), _mm256_extracti128_si256(result, 1));
  const __m128i pair = _mm_or_si128(half, _mm_shuffle_epi32(half, 0x4E));
  return static_cast<LaneMask>(_mm_cvtsi128_si32(_mm_or_si128(pair, _mm_shuffle_epi32(pair, 0xB1))));
}

/// The lanes, of eight, that have a neighbor among `reached`, as bits.
MESHHOOD_AVX2 inline LaneMask near8(__m256i adjacency, __m256i reached) {
  const __m256i none = _mm256_cmpeq_epi32(_mm256_and_si256(adjacency, reached), _mm256_setzero_si256());
  return ~bits(_mm256_castsi256_ps(none)) & 0xFFU;
}

MESHHOOD_AVX2 LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  const auto* rows = reinterpret_cast<const __m256i*>(adjacency);
  const __m256i row0 = _mm256_loadu_si256(rows);
  const __m256i row1 = _mm256_loadu_si256(rows + 1);
  const __m256i row2 = _mm256_loadu_si256(rows + 2);
  const __m256i row3 = _mm256_loadu_si256(rows + 3);
  for (LaneMask reached = from;;) {
    const __m256i all = _mm256_set1_epi32(static_cast<int>(reached));
    const LaneMask near = near8(row0, all) | near8(row1, all) << 8 | near8(row2, all) << 16 | near8(row3, all) << 24;
    const LaneMask grown = reached | (near & among);
    if (grown == reached) return reached;
    reached = grown;
  }
}

MESHHOOD_AVX2 inline GroupContainment classify_group(const Group& group, const TreeBall& ball) {
  const __m256 x = _mm256_sub_ps(_mm256_set1_ps(ball.x), _mm256_load_ps(group.x.data()));
  const __m256 y = _mm256_sub_ps(_mm256_set1_ps(ball.y), _mm256_load_ps(group.y.data()));
  const __m256 z = _mm256_sub_ps(_mm256_set1_ps(ball.z), _mm256_load_ps(group.z.data()));
  const __m256 square = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
  const __m256 radius = _mm256_load_ps(group.radius.data());
  const __m256 far = _mm256_add_ps(_mm256_set1_ps(ball.outer), radius);
  const __m256 near = _mm256_max_ps(_mm256_sub_ps(_mm256_set1_ps(ball.inner), radius), _mm256_setzero_ps());
  const unsigned outside = bits(_mm256_cmp_ps(square, _mm256_mul_ps(far, far), _CMP_GT_OQ));
  const unsigned inside = bits(_mm256_cmp_ps(square, _mm256_mul_ps(near, near), _CMP_LT_OQ));
  return {static_cast<std::uint8_t>(inside), static_cast<std::uint8_t>(~(outside | inside))};
}

MESHHOOD_AVX2 void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball,
                            GroupContainment* out) {
  constexpr std::size_t kGroupsAhead = 4;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i + kGroupsAhead < list.size()) {
      const auto* next = reinterpret_cast<const char*>(groups + list[i + kGroupsAhead]);
      for (std::size_t line = 0; line < sizeof(Group); line += 64) _mm_prefetch(next + line, _MM_HINT_T0);
    }
    out[i] = classify_group(groups[list[i]], ball);
  }
}

MESHHOOD_AVX2 VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  for (std::size_t i = 0; i < kLeafCapacity; i += 8) {
    const unsigned set = lanes >> i & 0xFFU;
    const auto* list = reinterpret_cast<const __m128i*>(kBitPositions[set].data());
    const __m256i order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(list));
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids + i));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_permutevar8x32_epi32(all, order));
    out += std::popcount(set);
  }
  return out;
}

}  // namespace

const Kernels& avx2_kernels() {
  static constexpr Kernels kAll{within_float, within_exact<double>, cross_edges, reachable, classify, compress};
  return kAll;
}

}  // namespace meshhood
#endif
