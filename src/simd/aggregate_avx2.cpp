// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#if defined(MESHHOOD_HAS_X86)
#define MESHHOOD_TARGET __attribute__((target("avx2")))
#define MESHHOOD_WIDTH 4
#define MESHHOOD_ROW_BITS 1, 2, 4, 8
#include "simd/aggregate_loops.h"

namespace meshhood {

const AggregateKernels& avx2_aggregate_kernels() { return kAggregateKernels; }

}  // namespace meshhood
#endif
