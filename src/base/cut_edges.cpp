// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"

#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns the vertex `edges[i]`, in [0, #V).
VertexId checked_end(const IndicesView& edges, std::size_t i, std::size_t vertices) {
  const std::uint64_t end = edges[i];
  if (end < vertices) return static_cast<VertexId>(end);
  raise_no_such_vertex(ErrorCode::VertexOutOfRange, "edge " + std::to_string(i / 2) + ": vertex ", to_text(edges, i),
                       vertices);
}

/// Marks `w` in the row of `v`. Returns whether it is there.
bool mark(const AdjacencyView& graph, VertexId v, VertexId w, std::vector<bool>& is_cut) {
  const auto row = graph[v];
  const auto found = std::lower_bound(row.begin(), row.end(), w);
  if (found == row.end() || *found != w) return false;
  is_cut[graph.offsets[v] + static_cast<std::size_t>(found - row.begin())] = true;
  return true;
}

std::vector<bool> marked(const AdjacencyView& graph, const IndicesView& edges) {
  std::vector<bool> is_cut(graph.neighbors.size());
  for (std::size_t row = 0; row < edges.size() / 2; ++row) {
    const VertexId v = checked_end(edges, 2 * row, graph.size());
    const VertexId w = checked_end(edges, 2 * row + 1, graph.size());
    if (mark(graph, v, w, is_cut) && mark(graph, w, v, is_cut)) continue;
    raise(ErrorCode::InvalidOption, "edge " + std::to_string(row) + ": vertices " + std::to_string(v) + " and " +
                                        std::to_string(w) + " are not joined by an edge");
  }
  return is_cut;
}

}  // namespace

Adjacency cut_edges(const AdjacencyView& graph, const IndicesView& edges) {
  if (edges.size() % 2 != 0) {
    raise(ErrorCode::InvalidOption, "edges: " + std::to_string(edges.size()) + " ends, expected two for each edge");
  }
  const std::vector<bool> is_cut = marked(graph, edges);
  Adjacency result;
  result.offsets.reserve(graph.offsets.size());
  if (!graph.offsets.empty()) result.offsets.push_back(0);
  for (std::size_t v = 0; v < graph.size(); ++v) {
    for (std::size_t i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
      if (!is_cut[i]) result.neighbors.push_back(graph.neighbors[i]);
    }
    result.offsets.push_back(static_cast<EdgeOffset>(result.neighbors.size()));
  }
  return result;
}

}  // namespace meshhood::inline v0_1
