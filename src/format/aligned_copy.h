// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "meshhood/serialize.h"

namespace meshhood::file {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector would initialise its memory before the copy.

/// A copy of bytes at an address with the alignment that `map` needs.
class AlignedCopy {
 public:
  explicit AlignedCopy(std::span<const std::byte> bytes)
      : lines_(std::make_unique_for_overwrite<Line[]>(bytes.size() / sizeof(Line) + 1)), size_(bytes.size()) {
    if (!bytes.empty()) std::memcpy(lines_.get(), bytes.data(), bytes.size());
  }

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(lines_.get()), size_};
  }

  /// Transfers the ownership of the bytes.
  [[nodiscard]] std::shared_ptr<const void> take_owner() { return std::shared_ptr<const Line[]>(std::move(lines_)); }

 private:
  struct alignas(kIndexAlignment) Line {
    std::array<std::byte, kIndexAlignment> bytes;
  };

  std::unique_ptr<Line[]> lines_;
  std::size_t size_;
};

// NOLINTEND(modernize-avoid-c-arrays)

}  // namespace meshhood::file
