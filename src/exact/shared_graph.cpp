// SPDX-License-Identifier: MIT
#include "exact/shared_graph.h"

#include <memory>

#include "base/parallel.h"
#include "exact/extract_graph.h"

namespace meshhood {

SharedGraph::~SharedGraph() { delete graph_.load(std::memory_order_acquire); }

const GraphData& SharedGraph::of(const IndexView& index) {
  const GraphData* found = graph_.load(std::memory_order_acquire);
  if (found != nullptr) return *found;
  TaskContext task;
  auto made = std::make_unique<const GraphData>(extract_graph(index, task));
  if (!graph_.compare_exchange_strong(found, made.get(), std::memory_order_acq_rel)) return *found;
  return *made.release();
}

}  // namespace meshhood
