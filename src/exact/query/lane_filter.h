// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshhood/filter.h"

#include "exact/layout.h"

namespace meshhood {

/// A mask of the caller, read a leaf at a time.
class LaneFilter {
 public:
  /// No vertex.
  LaneFilter() = default;

  /// The mask has a byte for each vertex, or is empty.
  LaneFilter(const IndexView& index, const VertexMask& mask) : index_(&index), bytes_(mask.bytes()) {}

  [[nodiscard]] bool empty() const { return bytes_.empty(); }

  /// Whether the mask has a vertex, by the caller's id.
  [[nodiscard]] bool has(VertexId id) const { return !empty() && bytes_[id] != 0; }

  /// Whether the mask has a vertex, in index order.
  [[nodiscard]] bool has_at(std::size_t vertex) const { return !empty() && bytes_[index_->id(vertex)] != 0; }

  /// The vertices of a leaf that are in the mask.
  [[nodiscard]] LaneMask of(LeafId leaf) const {
    if (empty()) return 0;
    LaneMask lanes = 0;
    const Leaf& record = index_->leaves[leaf];
    for (unsigned lane = 0; lane < record.size; ++lane) {
      const bool is_in = bytes_[index_->id(record.first + lane)] != 0;
      lanes |= LaneMask{is_in} << lane;
    }
    return lanes;
  }

 private:
  const IndexView* index_ = nullptr;
  std::span<const std::uint8_t> bytes_;
};

}  // namespace meshhood
