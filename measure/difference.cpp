// SPDX-License-Identifier: MIT
#include "measure/difference.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace meshhood::measure {

Difference Comparison::compare(std::span<const VertexId> exact, std::span<const VertexId> answer) {
  ++current_;
  for (const VertexId v : exact) stamps_[v] = current_;
  const auto common = static_cast<std::size_t>(
      std::count_if(answer.begin(), answer.end(), [this](VertexId v) { return stamps_[v] == current_; }));
  return {answer.size() - common, exact.size() - common};
}

}  // namespace meshhood::measure
