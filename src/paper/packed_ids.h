// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood::paper {

/// A list of numbers below a common bound, each in as few bits as the bound requires. The lowest cluster of each vertex
/// would otherwise take a tenth of the index.
class PackedIds {
 public:
  PackedIds() = default;
  PackedIds(std::size_t size, std::uint64_t bound)
      : width_(bound > 1 ? static_cast<unsigned>(std::bit_width(bound - 1)) : 1),
        // One word more, because reading a number always reads two words.
        words_(size * width_ / 64 + 2) {}

  void set(std::size_t i, std::uint64_t value) {
    const std::size_t bit = i * width_;
    const unsigned shift = bit % 64;
    words_[bit / 64] |= value << shift;
    // Two shifts, because a shift by 64 is undefined.
    words_[bit / 64 + 1] |= value >> 1 >> (63 - shift);
  }

  [[nodiscard]] std::uint64_t operator[](std::size_t i) const {
    const std::size_t bit = i * width_;
    const unsigned shift = bit % 64;
    const std::uint64_t high = words_[bit / 64 + 1] << 1 << (63 - shift);
    return (words_[bit / 64] >> shift | high) & ((std::uint64_t{1} << width_) - 1);
  }

  [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

 private:
  unsigned width_ = 1;  // of one number, in bits; at most 32
  std::vector<std::uint64_t> words_;
};

}  // namespace meshhood::paper
