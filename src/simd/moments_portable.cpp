// SPDX-License-Identifier: MIT
#include <cstddef>

#include "simd/moments.h"

#define MESHHOOD_MOMENTS

namespace meshhood {
namespace {

/// The queries whose number is > 0.
QueryWord positive(const QueryRow& row) {
  QueryWord word = 0;
  for (std::size_t q = 0; q < kPacketCapacity; ++q) word |= QueryWord{row[q] > 0} << q;
  return word;
}

}  // namespace
}  // namespace meshhood

#include "simd/moments_loops.h"

namespace meshhood {

const MomentKernels& portable_moment_kernels() { return kMomentKernels; }

const MomentKernels& moment_kernels(Isa isa) {
#if defined(MESHHOOD_HAS_X86)
  if (isa == Isa::Avx512) return avx512_moment_kernels();
  if (isa == Isa::Avx2) return avx2_moment_kernels();
#endif
  static_cast<void>(isa);
  return portable_moment_kernels();
}

}  // namespace meshhood
