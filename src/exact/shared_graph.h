// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "meshhood/adjacency.h"

namespace meshhood {

struct IndexView;

/// The graph of an index in the caller's order, made at its first use and kept for all searchers.
class SharedGraph {
 public:
  SharedGraph() = default;
  SharedGraph(const SharedGraph&) = delete;
  SharedGraph& operator=(const SharedGraph&) = delete;
  ~SharedGraph();

  /// The graph of `index`, which owns this object. Any thread may call it. There is no lock, because a fork could leave
  /// it held: if several threads make the graph at once, one result is kept. O(#V + #E) the first time.
  [[nodiscard]] const GraphData& of(const IndexView& index);

 private:
  std::atomic<const GraphData*> graph_{nullptr};
};

}  // namespace meshhood
