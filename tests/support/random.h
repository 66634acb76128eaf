// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace meshhood::test {

/// SplitMix64. The distributions of the standard library differ between implementations; these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  /// In [0, bound), `bound` > 0; nearly uniform.
  std::size_t below(std::uint64_t bound) { return static_cast<std::size_t>(bits() % bound); }

  /// In [low, high).
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53);
  }

  /// The numbers below `size` in a random order.
  std::vector<std::uint32_t> permutation(std::size_t size) {
    std::vector<std::uint32_t> result(size);
    for (std::size_t i = 0; i < size; ++i) {
      result[i] = static_cast<std::uint32_t>(i);
      std::swap(result[i], result[below(i + 1)]);
    }
    return result;
  }

 private:
  std::uint64_t state_;
};

}  // namespace meshhood::test
