// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/filter.h"

namespace meshhood {

/// A filter that owns its masks, so that nothing that the caller changes later has an effect.
class FilterCopy {
 public:
  explicit FilterCopy(const Filter& filter) : walls_(copy(filter.walls)), ignored_(copy(filter.ignored)) {}

  /// Valid as long as the copy.
  [[nodiscard]] Filter view() const { return {walls_, ignored_}; }

 private:
  static std::vector<std::uint8_t> copy(const VertexMask& mask) {
    std::vector<std::uint8_t> bytes(mask.size());
    for (std::size_t v = 0; v < bytes.size(); ++v) bytes[v] = mask[static_cast<VertexId>(v)] ? 1 : 0;
    return bytes;
  }

  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
};

}  // namespace meshhood
