// SPDX-License-Identifier: MIT
#include "simd/moments.h"

#if defined(MESHHOOD_HAS_X86)
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_MOMENTS __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2,popcnt")))

namespace meshhood {
namespace {

/// The queries whose number is > 0.
MESHHOOD_MOMENTS QueryWord positive(const QueryRow& row) {
  QueryWord word = 0;
  for (std::size_t q = 0; q < kPacketCapacity; q += 8) {
    const __mmask8 is_positive = _mm512_cmp_pd_mask(_mm512_load_pd(&row[q]), _mm512_setzero_pd(), _CMP_GT_OQ);
    word |= static_cast<QueryWord>(is_positive) << q;
  }
  return word;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& avx512_moment_kernels() { return kMomentKernels; }

}  // namespace meshhood
#endif
