// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood {

#if defined(MESHHOOD_NARROW_IDS)
using EdgeOffset = std::uint16_t;
#else
/// A place in a list of neighbours. Each edge stands in it twice.
using EdgeOffset = std::uint32_t;
#endif

/// The largest number of neighbours over all vertices: twice the number of edges.
inline constexpr std::size_t kMaxNeighbors = std::numeric_limits<EdgeOffset>::max();

/// A symmetric graph in CSR form, borrowed: the neighbours of `v` are `neighbors[offsets[v]] .. neighbors[offsets[v +
/// 1] - 1]`. Each row ascends, without repetition and without `v` itself.
struct AdjacencyView {
  std::span<const EdgeOffset> offsets;  ///< #V + 1
  std::span<const VertexId> neighbors;  ///< twice the number of edges

  /// #V.
  [[nodiscard]] std::size_t size() const { return offsets.empty() ? 0 : offsets.size() - 1; }

  [[nodiscard]] std::span<const VertexId> operator[](std::size_t v) const {
    return neighbors.subspan(offsets[v], offsets[v + 1] - offsets[v]);
  }
};

/// The same, owned.
struct Adjacency {
  std::vector<EdgeOffset> offsets;
  std::vector<VertexId> neighbors;

  [[nodiscard]] AdjacencyView view() const { return {offsets, neighbors}; }
};

/// Vertices with positions and a graph given directly, for whoever has no polygons. Borrowed like a `MeshView`.
struct GraphView {
  PositionsView positions;
  AdjacencyView adjacency;
};

/// Positions of either precision, owned. #V by 3.
using PositionsData = std::variant<std::vector<float>, std::vector<double>>;

/// A `GraphView`, owned.
struct GraphData {
  PositionsData positions;
  Adjacency adjacency;

  /// Borrows from this graph.
  [[nodiscard]] GraphView view() const {
    return {std::visit([](const auto& xyz) { return PositionsView(xyz); }, positions), adjacency.view()};
  }
};

/// The graph of a mesh (see `FacesView`). O(#V + #corners log(valence)); one thread.
///
/// Throws Error{InvalidMesh, TooLarge}, as `validate`, and where there are more than `kMaxNeighbors / 2` corners.
[[nodiscard]] Adjacency adjacency(const MeshView& mesh);

/// Throws unless the positions are valid, and the adjacency is what `AdjacencyView` says: one row a vertex, ascending,
/// symmetric, irreflexive, in range.
///
/// Throws Error{InvalidMesh, TooLarge}, naming the vertex. O(#V + #E log(valence)).
void validate(const GraphView& graph);

/// The mean length of the different edges, in the unit of the positions; 0 where there is none. The graph is valid.
/// O(#V + #E).
[[nodiscard]] double mean_edge_length(const GraphView& graph);

}  // namespace meshhood
