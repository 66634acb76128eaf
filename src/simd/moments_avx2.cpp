// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx2,bmi,popcnt")))

namespace meshhood {
namespace {

/// The queries whose number is > 0.
MESHHOOD_MOMENTS QueryWord positive(const QueryRow& row) {
  QueryWord word = 0;
  for (std::size_t q = 0; q < kPacketCapacity; q += 4) {
    const __m256d is_positive = _mm256_cmp_pd(_mm256_load_pd(&row[q]), _mm256_setzero_pd(), _CMP_GT_OQ);
    word |= static_cast<QueryWord>(_mm256_movemask_pd(is_positive)) << q;
  }
  return word;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& avx2_moment_kernels() { return kMomentKernels; }

}  // namespace meshhood
#endif
