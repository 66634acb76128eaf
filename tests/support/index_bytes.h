// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/serialize.h"

namespace meshhood::test {

/// A sink that appends to `bytes`.
[[nodiscard]] inline Sink append_to(std::vector<std::byte>& bytes) {
  return [&bytes](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); };
}

[[nodiscard]] inline std::vector<std::byte> saved(const Index& index, const SaveOptions& options = {}) {
  std::vector<std::byte> bytes;
  save(index, append_to(bytes), options);
  return bytes;
}

[[nodiscard]] inline std::vector<std::byte> saved(const paper::Index& index) {
  std::vector<std::byte> bytes;
  save(index, append_to(bytes));
  return bytes;
}

/// An aligned copy of bytes, to be mapped. It ends with the bytes if their number is a multiple of the alignment, so
/// that a sanitizer reports a read past the end.
class Mappable {
 public:
  explicit Mappable(std::span<const std::byte> bytes) : lines_(bytes.size() / sizeof(Line)), size_(bytes.size()) {
    if (size_ % sizeof(Line) != 0) lines_.emplace_back();
    std::ranges::copy(bytes, data());
  }

  [[nodiscard]] std::byte* data() { return lines_.empty() ? nullptr : lines_.front().bytes.data(); }
  [[nodiscard]] std::span<std::byte> bytes() { return {data(), size_}; }

 private:
  struct alignas(kIndexAlignment) Line {
    std::array<std::byte, kIndexAlignment> bytes;
  };

  std::vector<Line> lines_;
  std::size_t size_;
};

}  // namespace meshhood::test
