// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "meshhood/serialize.h"

namespace meshhood::io {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector would write to all of its memory before the file is read into it.

/// Bytes as they are read, where `map` of the core wants them.
class AlignedBuffer {
 public:
  explicit AlignedBuffer(std::size_t capacity) : lines_(make_lines(capacity)), capacity_(capacity) {}

  /// Where the next bytes go.
  [[nodiscard]] std::span<char> room() { return {chars() + size_, capacity_ - size_}; }

  /// So many have been written there.
  void add(std::size_t bytes) { size_ += bytes; }

  /// Makes room for as many again.
  void grow() {
    AlignedBuffer wider(2 * capacity_);
    std::copy_n(chars(), size_, wider.chars());
    wider.size_ = size_;
    *this = std::move(wider);
  }

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(lines_.get()), size_};
  }

  /// Who keeps the bytes from now on.
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

}  // namespace meshhood::io
