// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#include <algorithm>

#include "simd/wasm128.h"

namespace meshhood {
namespace {

Isa most_isa = Isa::Avx512;

Isa isa_of_processor() {
#if defined(MESHHOOD_HAS_X86)
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("bmi2") != 0) {
    return Isa::Avx512;
  }
  if (__builtin_cpu_supports("avx2") != 0) return Isa::Avx2;
#endif
  return Isa::Portable;
}

}  // namespace

Isa best_isa() { return std::min(isa_of_processor(), most_isa); }

void limit_isa(Isa most) { most_isa = most; }

const Kernels& kernels(Isa isa) {
#if defined(MESHHOOD_HAS_X86)
  if (isa == Isa::Avx512) return avx512_kernels();
  if (isa == Isa::Avx2) return avx2_kernels();
#endif
  static_cast<void>(isa);
#if defined(MESHHOOD_HAS_WASM128)
  return wasm128_kernels();
#else
  return portable_kernels();
#endif
}

}  // namespace meshhood
