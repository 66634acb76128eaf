// SPDX-License-Identifier: MIT
#include "exact/shared_graph.h"

#include <memory>

#include "meshhood/index.h"

namespace meshhood {

SharedGraph::~SharedGraph() { delete graph_.load(std::memory_order_acquire); }

const GraphData& SharedGraph::of(const Index& index) {
  const GraphData* found = graph_.load(std::memory_order_acquire);
  if (found != nullptr) return *found;
  auto made = std::make_unique<const GraphData>(extract_graph(index));
  if (!graph_.compare_exchange_strong(found, made.get(), std::memory_order_acq_rel)) return *found;
  return *made.release();
}

}  // namespace meshhood
