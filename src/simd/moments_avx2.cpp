// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx2,bmi,popcnt")))

namespace meshhood {
namespace {

MESHHOOD_MOMENTS inline QueryWord greater(__m256 numbers, __m256 limits) {
  return static_cast<QueryWord>(_mm256_movemask_ps(_mm256_cmp_ps(numbers, limits, _CMP_GT_OQ)));
}

/// Bit `i` is set if number `i` is > `limit`.
MESHHOOD_MOMENTS inline QueryWord greater(const Sixteen& numbers, float limit) {
  const auto* const halves = reinterpret_cast<const __m256*>(&numbers);
  const __m256 limits = _mm256_set1_ps(limit);
  return greater(halves[0], limits) | greater(halves[1], limits) << 8;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& avx2_moment_kernels() { return kMomentKernels; }

}  // namespace meshhood
#endif
