// SPDX-License-Identifier: MIT
#include "exact/shared_graph.h"

#include <memory>

#include "base/parallel.h"
#include "exact/extract_graph.h"

namespace meshhood {
namespace {

/// What `kept` points to; if it is null, first the result of `make()`.
template <class Graph, class Make>
const Graph& made_once(std::atomic<const Graph*>& kept, Make&& make) {
  const Graph* found = kept.load(std::memory_order_acquire);
  if (found != nullptr) return *found;
  auto made = std::make_unique<const Graph>(make());
  if (!kept.compare_exchange_strong(found, made.get(), std::memory_order_acq_rel)) return *found;
  return *made.release();
}

}  // namespace

SharedGraph::~SharedGraph() {
  delete graph_.load(std::memory_order_acquire);
  delete weighted_.load(std::memory_order_acquire);
}

const GraphData& SharedGraph::of(const IndexView& index) {
  return made_once(graph_, [&] {
    TaskContext task;
    return extract_graph(index, task);
  });
}

const WeightedGraph& SharedGraph::weighted(const IndexView& index) {
  return made_once(weighted_, [&] { return make_weighted_graph(index); });
}

}  // namespace meshhood
