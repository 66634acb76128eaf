// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstring>

#include "simd/moments.h"

#define MESHHOOD_MOMENTS

namespace meshhood {
namespace {

/// Bit `i` is set if number `i` is > `limit`. Copied first: g++ 12 with -fsanitize=undefined compiles `numbers[i] >
/// limit` wrongly.
inline QueryWord greater(const Sixteen& numbers, float limit) {
  std::array<float, kSixteen> row;
  std::memcpy(row.data(), &numbers, sizeof(row));
  QueryWord word = 0;
  for (std::size_t i = 0; i < kSixteen; ++i) word |= QueryWord{row[i] > limit} << i;
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
