// SPDX-License-Identifier: MIT
// Chooses between the targets for which the kernels are compiled.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

#include "meshhood/kernel_target.h"

#include "simd/kernels.h"
#include "simd/target_list.h"

namespace meshhood::inline v0_1 {
namespace {

#if defined(__x86_64__) || defined(__i386__)
/// Returns XCR0, which says which registers the operating system saves.
std::uint32_t saved_registers() {
  std::uint32_t low = 0;   // NOLINT(misc-const-correctness): the instruction writes both
  std::uint32_t high = 0;  // NOLINT(misc-const-correctness)
  asm volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

/// Returns whether this processor has the instructions of a target beyond the first of the list, and its operating
/// system allows them. `__builtin_cpu_supports` needs a library that not every compiler links; it then answers no.
// The bits: Intel 64 and IA-32 Architectures Software Developer's Manual, vol. 2A, CPUID; vol. 1, sec. 13.3, XCR0.
bool has_target(std::int64_t target) {
  constexpr std::uint32_t kSavesYmm = 0x06;
  constexpr std::uint32_t kSavesZmm = 0xE6;
  const auto all = [](std::uint32_t bits, std::uint32_t wanted) { return (bits & wanted) == wanted; };
  std::uint32_t basic = 0;
  std::uint32_t extended = 0;
  std::uint32_t unused = 0;
  if (__get_cpuid(1, &unused, &unused, &basic, &unused) == 0) return false;
  if (target == HWY_SSE4) return all(basic, bit_SSE3 | bit_SSSE3 | bit_SSE4_1 | bit_SSE4_2 | bit_POPCNT);
  if (!all(basic, bit_OSXSAVE) || __get_cpuid_count(7, 0, &unused, &extended, &unused, &unused) == 0) return false;
  if (target == HWY_AVX2) {
    return all(saved_registers(), kSavesYmm) && all(basic, bit_AVX | bit_FMA | bit_F16C) &&
           all(extended, bit_AVX2 | bit_BMI | bit_BMI2);
  }
  return target == HWY_AVX3 && all(saved_registers(), kSavesZmm) &&
         all(extended, bit_AVX512F | bit_AVX512BW | bit_AVX512DQ | bit_AVX512VL);
}
#else
bool has_target(std::int64_t /*target*/) { return false; }
#endif

/// Returns the last target that the processor has together with all before it.
Isa isa_of_processor() {
  std::size_t best = 0;
  while (best + 1 < kTargetIds.size() && has_target(kTargetIds[best + 1])) ++best;
  return static_cast<Isa>(best);
}

Isa most_isa{kTargetIds.size() - 1};

}  // namespace

Isa best_isa() {
  static const Isa of_processor = isa_of_processor();
  return std::min(of_processor, most_isa);
}

void limit_isa(Isa most) { most_isa = most; }

std::string_view kernel_target() { return name_of(best_isa()); }

const char* name_of(Isa isa) { return hwy::TargetName(kTargetIds[static_cast<std::size_t>(isa)]); }

}  // namespace meshhood::inline v0_1
