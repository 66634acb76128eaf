// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood {

/// A set of numbers that wait, in blocks of 64. Blocks are swept in ascending order, and again from the first to which
/// numbers were added meanwhile: a number that is added several times in a sweep is taken once, and what follows from
/// it far ahead waits until it is settled.
class PathFront {
 public:
  /// Empty, for numbers below `size`.
  void reset(std::size_t size) {
    blocks_.assign((size + 63) / 64, 0);
    next_ = blocks_.size();
  }

  void add(std::uint32_t number) {
    assert(number / 64 < blocks_.size());
    blocks_[number / 64] |= std::uint64_t{1} << number % 64;
    next_ = std::min<std::size_t>(next_, number / 64);
  }

  /// Calls `f(number)`, which may add numbers, until none is left.
  template <class F>
  void run(F&& f) {
    while (next_ < blocks_.size()) {
      const std::size_t block = next_++;
      std::uint64_t ahead = ~std::uint64_t{0};
      while ((blocks_[block] & ahead) != 0) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(blocks_[block] & ahead));
        blocks_[block] &= ~(std::uint64_t{1} << bit);
        ahead = ~std::uint64_t{0} << bit;
        f(static_cast<std::uint32_t>(block) * 64 + bit);
      }
    }
  }

 private:
  std::vector<std::uint64_t> blocks_;
  std::size_t next_ = 0;  // all blocks before are empty, except that which is swept
};

}  // namespace meshhood
