// SPDX-License-Identifier: MIT
#include "graph_copy.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"

#include "about.h"

namespace meshhood::python {
namespace {

// Ids are int32 in Python, as SciPy's sparse matrices have them.
constexpr std::size_t kMostVertices = std::numeric_limits<std::int32_t>::max();

/// The first edge of `some` that `all` does not have.
std::optional<std::pair<std::size_t, VertexId>> first_missing(const AdjacencyView& some, const AdjacencyView& all) {
  for (std::size_t v = 0; v < some.size(); ++v) {
    for (const VertexId w : some[v]) {
      if (!std::ranges::binary_search(all[v], w)) return std::pair(v, w);
    }
  }
  return std::nullopt;
}

}  // namespace

GraphData positions_copy(const PositionsView& positions, const char* argument) {
  GraphData copy;
  positions.visit([&](const auto& strided) {
    const auto xyz = strided.packed();
    copy.positions = std::vector(xyz.begin(), xyz.end());
  });
  about(argument, [&] {
    validate(copy.view().positions);
    check_vertex_count(positions.size());
  });
  return copy;
}

GraphData graph_copy(const MeshView& mesh) {
  GraphData copy = positions_copy(mesh.positions, "V");
  copy.adjacency = about("F", [&] { return adjacency({copy.view().positions, mesh.faces}); });
  return copy;
}

void check_faces(const GraphView& graph, const FacesView& faces) {
  const Adjacency of_faces = about("F", [&] { return adjacency({graph.positions, faces}); });
  const auto missing = first_missing(of_faces.view(), graph.adjacency);
  if (!missing || !first_missing(graph.adjacency, of_faces.view())) return;
  raise(ErrorCode::InvalidMesh, "F: faces of another mesh: one joins vertices " + std::to_string(missing->first) +
                                    " and " + std::to_string(missing->second) + ", which the index does not");
}

void check_vertex_count(std::size_t count) {
  if (count <= kMostVertices) return;
  raise(ErrorCode::TooLarge, std::to_string(count) + " vertices, but the limit is " + std::to_string(kMostVertices));
}

}  // namespace meshhood::python
