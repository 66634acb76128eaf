// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// The kernels are compiled for these targets of Highway, from slow to fast; each has the instructions of those before.

// Assertions of Highway would need its library.
#define HWY_IS_DEBUG_BUILD 0
// Without vector instructions, vectors have one lane, which leaves loops that the compiler understands.
#define HWY_BROKEN_EMU128 1
// ARM has one target, without the instructions for cryptography that Highway would use: not every processor has them.
#if defined(__arm__) || defined(__aarch64__)
#define TOOLCHAIN_MISS_SYS_AUXV_H
#endif
// Vectors of a length that is known only at run time do not fit into the rows of 32 lanes. The few processors that end
// at SSSE3 take the target without vector instructions. The targets that Highway numbers below AVX3 have instructions
// that no kernel uses; a build for such a processor (-march=native) takes AVX3.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | (HWY_AVX3 - 1LL))

#include <hwy/targets.h>

#if HWY_TARGETS & HWY_SSE4 & ~HWY_STATIC_TARGET
#define MESHHOOD_SSE4(what) what,
#else
#define MESHHOOD_SSE4(what)
#endif
#if HWY_TARGETS & HWY_AVX2 & ~HWY_STATIC_TARGET
#define MESHHOOD_AVX2(what) what,
#else
#define MESHHOOD_AVX2(what)
#endif
#if HWY_TARGETS & HWY_AVX3 & ~HWY_STATIC_TARGET
#define MESHHOOD_AVX3(what) what,
#else
#define MESHHOOD_AVX3(what)
#endif

/// Selects the table for `isa` among the tables of this name, of which each target has one.
#define MESHHOOD_TABLE(name, isa)                                                                   \
  *std::array{&HWY_STATIC_DISPATCH(name), MESHHOOD_SSE4(&N_SSE4::name) MESHHOOD_AVX2(&N_AVX2::name) \
                                              MESHHOOD_AVX3(&N_AVX3::name)}[static_cast<std::size_t>(isa)]

namespace meshhood::inline v0_1 {

/// The numbers of the targets in Highway.
inline constexpr auto kTargetIds = std::to_array<std::int64_t>(
    {HWY_STATIC_TARGET, MESHHOOD_SSE4(HWY_SSE4) MESHHOOD_AVX2(HWY_AVX2) MESHHOOD_AVX3(HWY_AVX3)});

}  // namespace meshhood::inline v0_1
