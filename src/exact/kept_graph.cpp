// SPDX-License-Identifier: MIT
#include "exact/kept_graph.h"

#include <memory>

namespace meshhood {

KeptGraph::~KeptGraph() { delete graph_.load(std::memory_order_acquire); }

const WeightedGraph& KeptGraph::of(const IndexView& index) {
  const WeightedGraph* found = graph_.load(std::memory_order_acquire);
  if (found != nullptr) return *found;
  auto made = std::make_unique<const WeightedGraph>(make_weighted_graph(index));
  if (!graph_.compare_exchange_strong(found, made.get(), std::memory_order_acq_rel)) return *found;
  return *made.release();
}

}  // namespace meshhood
