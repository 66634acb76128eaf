// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "meshhood/adjacency.h"

namespace meshhood {

class Index;

/// The graph of an index in the caller's order, made when it is first asked for and kept for all searchers.
class SharedGraph {
 public:
  SharedGraph() = default;
  SharedGraph(const SharedGraph&) = delete;
  SharedGraph& operator=(const SharedGraph&) = delete;
  ~SharedGraph();

  /// That of `index`, which this belongs to. From any thread. Without a lock, which a fork could leave held: of several
  /// threads that make the graph at once, one keeps its own. O(#V + #E) the first time.
  [[nodiscard]] const GraphData& of(const Index& index);

 private:
  std::atomic<const GraphData*> graph_{nullptr};
};

}  // namespace meshhood
