// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "exact/layout.h"

namespace meshhood {

/// Whether leaves have many links of few edges, as around hubs and in random graphs. A step from leaf to leaf then
/// reaches few vertices, and breadth-first search over vertices is faster at every radius.
[[nodiscard]] bool is_unlike_a_surface(const IndexView& index);

/// Answers queries on such graphs by the reference search, on a graph that all searchers of the index share.
class VertexBfs {
 public:
  explicit VertexBfs(const Index& index);

  [[nodiscard]] ReferenceSearcher& searcher() { return searcher_; }

  /// The neighborhood as ranges in index order, ascending; valid until the next call.
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);

 private:
  const IndexView* index_;
  ReferenceSearcher searcher_;
  std::vector<VertexId> vertices_;  // in index order
  std::vector<VertexRange> ranges_;
};

}  // namespace meshhood
