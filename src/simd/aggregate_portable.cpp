// SPDX-License-Identifier: MIT
#define MESHHOOD_TARGET
#define MESHHOOD_WIDTH 2
#define MESHHOOD_ROW_BITS 1, 2
#include "simd/aggregate_loops.h"

namespace meshhood {

const AggregateKernels& portable_aggregate_kernels() { return kAggregateKernels; }

const AggregateKernels& aggregate_kernels(Isa isa) {
#if defined(MESHHOOD_HAS_X86)
  if (isa == Isa::Avx512) return avx512_aggregate_kernels();
  if (isa == Isa::Avx2) return avx2_aggregate_kernels();
#endif
  static_cast<void>(isa);
  return portable_aggregate_kernels();
}

}  // namespace meshhood
