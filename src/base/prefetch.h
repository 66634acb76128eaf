// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace meshhood::inline v0_1 {

/// Asks the processor to fetch what lies at `address`, which will be read soon. It never faults. Loops keep the number
/// of items they prefetch ahead in a constant named after the items: `kLeavesAhead`.
inline void prefetch(const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
  // Without this, g++ treats a function that only prefetches as one without effect, and removes its calls.
  asm volatile("");
#else
  static_cast<void>(address);
#endif
}

inline constexpr std::size_t kCacheLine = 64;

/// Prefetches `count` lines from `address` on, which may be null; the memory may end before the last line.
inline void fetch_lines(const void* address, std::size_t count) {
  // Arithmetic on the pointer would be undefined beyond the end of an array.
  const auto first = reinterpret_cast<std::uintptr_t>(address);
  for (std::size_t i = 0; i < count; ++i) {
    prefetch(reinterpret_cast<const void*>(first + i * kCacheLine));  // NOLINT(performance-no-int-to-ptr)
  }
}

}  // namespace meshhood::inline v0_1
