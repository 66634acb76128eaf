// SPDX-License-Identifier: MIT
#include "batch/path_rows.h"

#include <algorithm>

#include "exact/index_access.h"

namespace meshhood {

PathRows::PathRows(const Index& index, Isa isa)
    : view_(IndexAccess::view(index)), graph_(IndexAccess::share_graph(index)), packet_(view_, *graph_, isa) {}

bool PathRows::pays(std::span<const BatchItem> items, bool /*distances*/) const {
  constexpr std::size_t kFewestTogether = 4;  // fewer rows of a leaf are answered faster one by one
  return items.size() >= kFewestTogether;
}

bool PathRows::run(std::span<const RowRun> runs) {
  const auto& [items, is_joint] = runs.front();
  queries_.clear();
  for (const auto& [row, vertex, position, radius] : items) {
    queries_.push_back({view_.place_at(position), radius});
  }
  if (is_joint) return packet_.run(queries_);
  packet_.run_single(queries_.front());
  return true;
}

bool PathRows::write(std::span<const BatchItem> items, const RowAnswers& /*answers*/, bool distances,
                     RowReceiver& receiver) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::span<const Path> paths = packet_.paths_in_order(i);
    const BatchMemory memory = receiver.memory(items[i].row, paths.size());
    for (std::size_t k = 0; k < paths.size(); ++k) memory.ids[k] = view_.id(paths[k].end);
    if (distances) std::ranges::transform(paths, memory.distances.begin(), &Path::length);
    if (!receiver.done(items[i].row)) return false;
  }
  return true;
}

}  // namespace meshhood
