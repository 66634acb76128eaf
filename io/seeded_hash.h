// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <chrono>
#include <cstdint>
#include <type_traits>

/// A hash of coordinates that differs from run to run, so that no file can be made whose positions collide. Results
/// must not depend on it.
namespace meshhood::inline v0_1::io {

[[nodiscard]] inline std::uint64_t mixed(std::uint64_t word) {
  word *= 0x9e3779b97f4a7c15U;
  return word ^ (word >> 32U);
}

/// Not known before the program runs: the time, and where the system has put `place` in memory.
[[nodiscard]] inline std::uint64_t new_seed(const void* place) {
  const auto time = static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  return mixed(time ^ mixed(reinterpret_cast<std::uintptr_t>(place)));
}

/// -0 has the hash of 0.
template <class Real>
[[nodiscard]] std::uint64_t hash_with(std::uint64_t hash, Real coordinate) {
  using Bits = std::conditional_t<sizeof(Real) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>;
  return mixed(hash ^ std::bit_cast<Bits>(coordinate + Real{0}));  // -0 + 0 is 0
}

}  // namespace meshhood::inline v0_1::io
