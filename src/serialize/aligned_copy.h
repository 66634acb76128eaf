// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "meshhood/serialize.h"

namespace meshhood::file {

/// A copy of bytes, where `map` wants them.
class AlignedCopy {
 public:
  explicit AlignedCopy(std::span<const std::byte> bytes)
      : lines_(std::make_unique_for_overwrite<Line[]>(bytes.size() / sizeof(Line) + 1)), size_(bytes.size()) {
    if (!bytes.empty()) std::memcpy(lines_.get(), bytes.data(), bytes.size());
  }

  [[nodiscard]] std::span<const std::byte> bytes() const { return {lines_[0].bytes, size_}; }

  /// Who keeps the bytes from now on.
  [[nodiscard]] std::shared_ptr<const void> take_owner() { return std::shared_ptr<const Line[]>(std::move(lines_)); }

 private:
  struct alignas(kIndexAlignment) Line {
    std::byte bytes[kIndexAlignment];  // NOLINT(modernize-avoid-c-arrays)
  };

  std::unique_ptr<Line[]> lines_;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it
  std::size_t size_;
};

}  // namespace meshhood::file
