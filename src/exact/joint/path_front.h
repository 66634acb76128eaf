// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood {

/// A set of numbers that wait, in blocks of 32. A block is swept up and down until it is empty, then the next block
/// that is not, and again from the first to which numbers were added meanwhile. So a number that is added several times
/// in a sweep is taken once, and what follows from it far ahead waits until it is settled. To sweep in both directions
/// halves the sweeps that the algorithm of Bellman and Ford needs (Yen 1970).
class PathFront {
 public:
  /// Empty, for numbers below `size`.
  void reset(std::size_t size) {
    blocks_.assign((size + kBlock - 1) / kBlock, 0);
    next_ = blocks_.size();
  }

  void add(std::uint32_t number) {
    assert(number / kBlock < blocks_.size());
    blocks_[number / kBlock] |= std::uint32_t{1} << number % kBlock;
    next_ = std::min<std::size_t>(next_, number / kBlock);
  }

  /// Calls `f(number)`, which may add numbers, until none is left.
  template <class F>
  void run(F&& f) {
    while (next_ < blocks_.size()) {
      const std::size_t block = next_++;
      const auto take = [&](int bit) {
        blocks_[block] &= ~(std::uint32_t{1} << bit);
        f(static_cast<std::uint32_t>(block * kBlock) + static_cast<std::uint32_t>(bit));
      };
      while (blocks_[block] != 0) {
        for (std::uint32_t left = blocks_[block]; left != 0;) {
          const int bit = std::countr_zero(left);
          take(bit);
          left = blocks_[block] & ~std::uint32_t{0} << bit;
        }
        for (std::uint32_t left = blocks_[block]; left != 0;) {
          const int bit = 31 - std::countl_zero(left);
          take(bit);
          left = blocks_[block] & ~std::uint32_t{0} >> (31 - bit);
        }
      }
    }
  }

 private:
  static constexpr std::size_t kBlock = 32;

  std::vector<std::uint32_t> blocks_;
  std::size_t next_ = 0;  // all blocks before are empty, except that which is swept
};

}  // namespace meshhood
