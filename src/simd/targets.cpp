// SPDX-License-Identifier: MIT
// The choice between the targets for which the kernels are compiled.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "meshhood/kernel_target.h"

#include "simd/kernels.h"
#include "simd/processor.h"
#include "simd/target_list.h"

namespace meshhood {
namespace {

/// Whether the processor has a target beyond the first of the list.
bool runs_on(const Processor& processor, std::int64_t target) {
  switch (target) {
    case HWY_SSE4: return processor.sse4;
    case HWY_AVX2: return processor.avx2;
    case HWY_AVX3: return processor.avx512;
    default: return false;
  }
}

Isa isa_of_processor() {
  const Processor processor = this_processor();
  std::size_t best = 0;
  while (best + 1 < kTargetIds.size() && runs_on(processor, kTargetIds[best + 1])) ++best;
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

}  // namespace meshhood
