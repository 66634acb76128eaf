// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx2,bmi,popcnt")))

namespace meshhood {
namespace {

MESHHOOD_MOMENTS inline QueryWord positive_half(__m256d numbers) {
  return static_cast<QueryWord>(_mm256_movemask_pd(_mm256_cmp_pd(numbers, _mm256_setzero_pd(), _CMP_GT_OQ)));
}

/// Bit `i` is set if number `i` is > 0.
MESHHOOD_MOMENTS inline QueryWord positive(const Eight& numbers) {
  const auto* const halves = reinterpret_cast<const __m256d*>(&numbers);
  return positive_half(halves[0]) | positive_half(halves[1]) << 4;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& avx2_moment_kernels() { return kMomentKernels; }

}  // namespace meshhood
#endif
