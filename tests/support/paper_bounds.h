// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::test {

/// Checks the promise of the paper's method: its answer contains the exact one and lies in the ball.
class PaperBounds {
 public:
  explicit PaperBounds(std::size_t vertices) : seen_(vertices, 0) {}

  /// Whether `paper` has every vertex of `exact`, no vertex twice, and none for which `inside(w)` is false.
  template <class Inside>
  [[nodiscard]] bool holds(std::span<const VertexId> exact, std::span<const VertexId> paper, Inside&& inside) {
    ++query_;
    for (const VertexId w : paper) {
      if (w >= seen_.size() || seen_[w] == query_ || !inside(w)) return false;
      seen_[w] = query_;
    }
    for (const VertexId w : exact) {
      if (seen_[w] != query_) return false;
    }
    return true;
  }

 private:
  std::vector<std::uint64_t> seen_;
  std::uint64_t query_ = 0;
};

}  // namespace meshhood::test
