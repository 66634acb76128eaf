// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#if defined(MESHHOOD_HAS_X86)
#define MESHHOOD_TARGET __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq")))
#define MESHHOOD_WIDTH 8
#define MESHHOOD_ROW_BITS 1, 2, 4, 8, 16, 32, 64, 128
#include "simd/aggregate_loops.h"

namespace meshhood {

const AggregateKernels& avx512_aggregate_kernels() { return kAggregateKernels; }

}  // namespace meshhood
#endif
