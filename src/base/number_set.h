// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace meshhood::inline v0_1 {

/// A set of numbers below a bound, as bits, with a bit for each word of them in a summary. It lists its numbers in
/// ascending order without sorting them.
class NumberSet {
 public:
  explicit NumberSet(std::size_t bound) : words_(bound / 64 + 1), summary_(bound / 4096 + 1) {}

  void insert(std::size_t number) {
    assert(number / 64 < words_.size());
    words_[number / 64] |= bit(number);
    summary_[number / 4096] |= bit(number / 64);
  }

  /// Takes O(bound / 4096 + numbers).
  void clear() {
    take_all([](std::size_t) {});
  }

  /// Calls `f(number)` for each number, ascending, and removes it. O(bound / 4096 + numbers).
  template <class F>
  void take_all(F&& f) {
    take_words([&](std::size_t first, std::uint64_t bits) {
      for (; bits != 0; bits &= bits - 1) f(first + static_cast<std::size_t>(std::countr_zero(bits)));
    });
  }

  /// Does the same by words: calls `f(first, bits)`, where bit `i` stands for the number `first + i`.
  template <class F>
  void take_words(F&& f) {
    for (std::size_t s = 0; s < summary_.size(); ++s) {
      for (; summary_[s] != 0; summary_[s] &= summary_[s] - 1) {
        const std::size_t w = 64 * s + static_cast<std::size_t>(std::countr_zero(summary_[s]));
        f(64 * w, std::exchange(words_[w], 0));
      }
    }
  }

 private:
  [[nodiscard]] static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << number % 64; }

  std::vector<std::uint64_t> words_;
  std::vector<std::uint64_t> summary_;
};

}  // namespace meshhood::inline v0_1
