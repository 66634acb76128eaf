// SPDX-License-Identifier: MIT
// The kernels, compiled once for each target of Highway that can matter, and the choice between them.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "meshhood/kernel_target.h"

#include "simd/aggregate.h"
#include "simd/joint.h"
#include "simd/kernels.h"
#include "simd/leaf.h"
#include "simd/moments.h"
#include "simd/processor.h"

#ifndef MESHHOOD_SIMD_TARGET
#define MESHHOOD_SIMD_TARGET
namespace meshhood {
namespace {

/// The kernels of one target.
struct Target {
  std::int64_t id;  // of Highway
  const Kernels* ball;
  const JointKernels* joint;
  const AggregateKernels* aggregate;
  const MomentKernels* moments;
};

/// Bit `i` for each lane `i`.
template <class T>
alignas(64) constexpr PerLane<T> kLaneBits = [] {
  PerLane<T> bits{};
  for (std::size_t i = 0; i < kLeafCapacity; ++i) bits[i] = static_cast<T>(T{1} << i);
  return bits;
}();

/// For every set of four words of 32 bits: the places of their bytes.
[[maybe_unused]] alignas(16) constexpr std::array<std::array<std::uint8_t, 16>, 16> kBytePlaces = [] {
  std::array<std::array<std::uint8_t, 16>, 16> lists{};
  for (std::size_t set = 0; set < 16; ++set) {
    for (std::size_t i = 0; i < 16; ++i)
      lists[set][i] = static_cast<std::uint8_t>(4 * kBitPositions[set][i / 4] + i % 4);
  }
  return lists;
}();

}  // namespace
}  // namespace meshhood

// Assertions of Highway would need its library.
#define HWY_IS_DEBUG_BUILD 0
// Without vector instructions, vectors of one lane, which leave loops that the compiler understands.
#define HWY_BROKEN_EMU128 1
// On ARM, one target, without the instructions for cryptography that Highway would allow itself: not every processor
// has them.
#if defined(__arm__) || defined(__aarch64__)
#define TOOLCHAIN_MISS_SYS_AUXV_H
#endif
// Vectors of a length that is known only at run time do not fit into the rows of 32 lanes; and the few processors that
// end at SSSE3 take what has no vector instructions.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/targets.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// clang-format off: each may use those before it.
#include "simd/wasm_doubles-inl.h"
#include "simd/lanes-inl.h"
#include "simd/ball-inl.h"
#include "simd/joint-inl.h"
#include "simd/aggregate-inl.h"
#include "simd/moments-inl.h"
// clang-format on

namespace meshhood::HWY_NAMESPACE {
namespace {
constexpr Target kTarget{HWY_TARGET, &kBallKernels, &kJointKernels, &kAggregateKernels, &kMomentKernels};
}  // namespace
}  // namespace meshhood::HWY_NAMESPACE

#if HWY_ONCE
namespace meshhood {
namespace {

/// From slow to fast, each with the instructions of those before it.
constexpr std::array kTargets{
    &HWY_STATIC_DISPATCH(kTarget),
#if HWY_TARGETS & HWY_SSE4 & ~HWY_STATIC_TARGET
    &N_SSE4::kTarget,
#endif
#if HWY_TARGETS & HWY_AVX2 & ~HWY_STATIC_TARGET
    &N_AVX2::kTarget,
#endif
#if HWY_TARGETS & HWY_AVX3 & ~HWY_STATIC_TARGET
    &N_AVX3::kTarget,
#endif
};

bool runs_on(const Processor& processor, std::int64_t target) {
  switch (target) {
    case HWY_STATIC_TARGET: return true;
    case HWY_SSE4: return processor.sse4;
    case HWY_AVX2: return processor.avx2;
    case HWY_AVX3: return processor.avx512;
    default: return false;
  }
}

Isa isa_of_processor() {
  const Processor processor = this_processor();
  std::size_t best = 0;
  while (best + 1 < kTargets.size() && runs_on(processor, kTargets[best + 1]->id)) ++best;
  return static_cast<Isa>(best);
}

const Target& target(Isa isa) { return *kTargets[static_cast<std::size_t>(isa)]; }

Isa most_isa{kTargets.size() - 1};

}  // namespace

Isa best_isa() {
  static const Isa of_processor = isa_of_processor();
  return std::min(of_processor, most_isa);
}

void limit_isa(Isa most) { most_isa = most; }

std::string_view kernel_target() { return name_of(best_isa()); }

const char* name_of(Isa isa) { return hwy::TargetName(target(isa).id); }

const Kernels& kernels(Isa isa) { return *target(isa).ball; }
const JointKernels& joint_kernels(Isa isa) { return *target(isa).joint; }
const AggregateKernels& aggregate_kernels(Isa isa) { return *target(isa).aggregate; }
const MomentKernels& moment_kernels(Isa isa) { return *target(isa).moments; }

}  // namespace meshhood
#endif
