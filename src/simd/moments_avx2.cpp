// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx2,bmi,popcnt")))

namespace meshhood {
namespace {

/// Bit `i` is set if number `i` is > 0.
MESHHOOD_MOMENTS inline QueryWord positive(const Eight& numbers) {
  const auto* const halves = reinterpret_cast<const __m256d*>(&numbers);
  const auto word = [](__m256d half) MESHHOOD_MOMENTS {
    return static_cast<QueryWord>(_mm256_movemask_pd(_mm256_cmp_pd(half, _mm256_setzero_pd(), _CMP_GT_OQ)));
  };
  return word(halves[0]) | word(halves[1]) << 4;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& avx2_moment_kernels() { return kMomentKernels; }

}  // namespace meshhood
#endif
