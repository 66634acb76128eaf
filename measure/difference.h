// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::measure {

/// How an answer differs from the exact one.
struct Difference {
  std::size_t extra = 0;
  std::size_t missing = 0;
};

/// Compares sets of vertices without sorting them. One object serves any number of comparisons.
class Comparison {
 public:
  explicit Comparison(std::size_t vertices) : stamps_(vertices, 0) {}

  /// Neither list has duplicates.
  [[nodiscard]] Difference compare(std::span<const VertexId> exact, std::span<const VertexId> answer);

 private:
  std::vector<std::uint64_t> stamps_;  // by vertex: the last comparison whose exact answer contains it
  std::uint64_t current_ = 0;
};

}  // namespace meshhood::measure
