// SPDX-License-Identifier: MIT
#include "batch/sort_answer.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace meshhood {

void sort_answer(std::span<VertexId> ids, std::span<double> distances) {
  if (std::is_sorted(ids.begin(), ids.end())) return;
  if (distances.empty()) {
    std::sort(ids.begin(), ids.end());
    return;
  }
  std::vector<std::pair<VertexId, double>> pairs(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) pairs[i] = {ids[i], distances[i]};
  std::sort(pairs.begin(), pairs.end());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = pairs[i].first;
    distances[i] = pairs[i].second;
  }
}

}  // namespace meshhood
