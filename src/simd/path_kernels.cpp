// SPDX-License-Identifier: MIT
// The kernels of shortest paths, compiled once for each target.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "simd/lane_tables.h"
#include "simd/leaf.h"
#include "simd/paths.h"
#include "simd/query_word.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/path_kernels.cpp"
// clang-format off: each uses those before it.
#include "simd/each_target-inl.h"
#include "simd/path-inl.h"
// clang-format on

#if HWY_ONCE
namespace meshhood {

const PathKernels& path_kernels(Isa isa) {
  static constexpr std::array kTables{MESHHOOD_TABLES(kPathKernels)};
  return *kTables[static_cast<std::size_t>(isa)];
}

}  // namespace meshhood
#endif
