// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "meshhood/serialize.h"

namespace meshhood::inline v0_1 {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector would initialize its memory before it is overwritten.

/// A growing array of bytes, at the alignment that `map` requires.
class AlignedBuffer {
 public:
  explicit AlignedBuffer(std::size_t capacity) : lines_(make_lines(capacity)), capacity_(capacity) {}

  [[nodiscard]] static AlignedBuffer copy_of(std::span<const std::byte> bytes) {
    AlignedBuffer copy(bytes.size());
    if (!bytes.empty()) std::memcpy(copy.chars(), bytes.data(), bytes.size());
    copy.add(bytes.size());
    return copy;
  }

  /// Returns the unused memory at the end.
  [[nodiscard]] std::span<char> room() { return {chars() + size_, capacity_ - size_}; }

  /// Appends the first `bytes` of `room()`.
  void add(std::size_t bytes) {
    assert(bytes <= capacity_ - size_);
    size_ += bytes;
  }

  void grow() {
    AlignedBuffer larger(2 * capacity_);
    std::copy_n(chars(), size_, larger.chars());
    larger.size_ = size_;
    *this = std::move(larger);
  }

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(lines_.get()), size_};
  }

  /// Moves the ownership of the bytes out; `bytes()` taken before stay valid as long as the result lives.
  [[nodiscard]] std::shared_ptr<const void> take_owner() { return std::shared_ptr<const Line[]>(std::move(lines_)); }

 private:
  struct alignas(kIndexAlignment) Line {
    std::array<std::byte, kIndexAlignment> bytes;
  };
  using Lines = std::unique_ptr<Line[]>;

  static Lines make_lines(std::size_t bytes) {
    return std::make_unique_for_overwrite<Line[]>(bytes / sizeof(Line) + 1);
  }

  [[nodiscard]] char* chars() { return reinterpret_cast<char*>(lines_.get()); }

  Lines lines_;
  std::size_t capacity_;
  std::size_t size_ = 0;
};

// NOLINTEND(modernize-avoid-c-arrays)

}  // namespace meshhood::inline v0_1
