// SPDX-License-Identifier: MIT
#include "simd/processor.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cstdint>

#include <cpuid.h>
#endif

namespace meshhood {

#if defined(__x86_64__) || defined(__i386__)
namespace {

/// The registers whose contents the operating system saves: XCR0.
std::uint32_t saved_registers() {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

constexpr bool has(std::uint32_t bits, std::uint32_t wanted) { return (bits & wanted) == wanted; }

}  // namespace

// The bits: Intel 64 and IA-32 Architectures Software Developer's Manual, vol. 2A, CPUID; vol. 1, sec. 13.3, XCR0.
Processor this_processor() {
  constexpr std::uint32_t kSavesYmm = 0x06;
  constexpr std::uint32_t kSavesZmm = 0xE6;
  std::uint32_t eax = 0;
  std::uint32_t basic = 0;
  std::uint32_t edx = 0;
  std::uint32_t unused = 0;
  Processor processor;
  if (__get_cpuid(1, &eax, &unused, &basic, &edx) == 0) return processor;
  processor.sse4 = has(basic, bit_SSE3 | bit_SSSE3 | bit_SSE4_1 | bit_SSE4_2 | bit_POPCNT);
  std::uint32_t extended = 0;
  if (!processor.sse4 || !has(basic, bit_OSXSAVE) || __get_cpuid_count(7, 0, &eax, &extended, &unused, &edx) == 0) {
    return processor;
  }
  const std::uint32_t saved = saved_registers();
  processor.avx2 =
      has(saved, kSavesYmm) && has(basic, bit_AVX | bit_FMA | bit_F16C) && has(extended, bit_AVX2 | bit_BMI | bit_BMI2);
  processor.avx512 = processor.avx2 && has(saved, kSavesZmm) &&
                     has(extended, bit_AVX512F | bit_AVX512BW | bit_AVX512DQ | bit_AVX512VL);
  return processor;
}
#else
Processor this_processor() { return {}; }
#endif

}  // namespace meshhood
