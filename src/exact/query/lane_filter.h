// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/filter.h"

#include "exact/layout.h"

namespace meshhood {

/// A mask of the caller, read a leaf at a time.
class LaneFilter {
 public:
  /// No vertex.
  LaneFilter() = default;

  /// The mask has a value for each vertex, or is empty.
  LaneFilter(const IndexView& index, const VertexMask& mask) : index_(&index), mask_(mask) {}

  [[nodiscard]] bool empty() const { return mask_.size() == 0; }

  /// Whether the mask has a vertex, by the caller's id.
  [[nodiscard]] bool has(VertexId id) const { return !empty() && mask_[id]; }

  /// Whether the mask has a vertex, in index order.
  [[nodiscard]] bool has_at(std::size_t vertex) const { return !empty() && mask_[index_->id(vertex)]; }

  /// The vertices of a leaf that are in the mask.
  [[nodiscard]] LaneMask of(LeafId leaf) const {
    if (empty()) return 0;
    LaneMask lanes = 0;
    const Leaf& record = index_->leaves[leaf];
    for (unsigned lane = 0; lane < record.size; ++lane) {
      lanes |= LaneMask{mask_[index_->id(record.first + lane)]} << lane;
    }
    return lanes;
  }

 private:
  const IndexView* index_ = nullptr;
  VertexMask mask_;
};

}  // namespace meshhood
