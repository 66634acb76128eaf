// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/vertex_id.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The largest number of neighbors over all vertices, which is twice the number of edges.
inline constexpr std::size_t kMaxNeighbors = (std::numeric_limits<EdgeOffset>::max)();

/// Borrows a symmetric graph in CSR form: the neighbors of `v` are `neighbors[offsets[v]] .. neighbors[offsets[v + 1] -
/// 1]`. Each row ascends, without repetition and without `v` itself.
struct AdjacencyView {
  Borrowed<EdgeOffset> offsets;  ///< #V + 1; may be empty if there are no vertices
  Borrowed<VertexId> neighbors;  ///< twice the number of edges

  AdjacencyView() = default;

  /// Both are needed: with one alone, `build({positions, triangles})` would take the triangles for offsets.
  AdjacencyView(Borrowed<EdgeOffset> row_offsets, Borrowed<VertexId> ids) : offsets(row_offsets), neighbors(ids) {}

  /// Returns #V.
  [[nodiscard]] std::size_t size() const { return offsets.empty() ? 0 : offsets.size() - 1; }

  /// Returns the neighbors of `v`; `v` is less than #V.
  [[nodiscard]] std::span<const VertexId> operator[](std::size_t v) const {
    return neighbors.subspan(offsets[v], offsets[v + 1] - offsets[v]);
  }
};

/// Owns a graph as `AdjacencyView` describes it.
struct Adjacency {
  std::vector<EdgeOffset> offsets;
  std::vector<VertexId> neighbors;

  /// Borrows from this object. A view of a temporary does not compile.
  [[nodiscard]] AdjacencyView view() const& { return {offsets, neighbors}; }
  [[nodiscard]] AdjacencyView view() const&& = delete;
};

/// Vertices with positions and a graph given directly, for data without polygons. Borrowed like a `MeshView`.
struct GraphView {
  PositionsView positions;
  AdjacencyView adjacency;

  GraphView() = default;
  GraphView(const PositionsView& xyz, const AdjacencyView& graph) : positions(xyz), adjacency(graph) {}
};

/// Positions of either precision, owned: #V by 3, row by row.
using PositionsData = std::variant<std::vector<float>, std::vector<double>>;

/// Owns what a `GraphView` borrows.
struct GraphData {
  PositionsData positions;
  Adjacency adjacency;

  /// Borrows from this object. A view of a temporary does not compile.
  [[nodiscard]] GraphView view() const& {
    return {std::visit([](const auto& xyz) { return PositionsView(xyz); }, positions), adjacency.view()};
  }
  [[nodiscard]] GraphView view() const&& = delete;
};

/// Returns the graph of a mesh (see `FacesView`). Takes O(#V + #corners log(valence)), on one thread.
///
/// Throws Error{InvalidMesh, TooLarge}, as `validate`, and if there are more than `kMaxNeighbors / 2` corners.
[[nodiscard]] Adjacency adjacency(const MeshView& mesh);

/// Throws unless the positions are valid and the adjacency is as `AdjacencyView` requires: one row per vertex, each
/// ascending, in range and without the vertex itself; and symmetric.
///
/// Throws Error{InvalidMesh, TooLarge}, naming the vertex. Takes O(#V + #E log(valence)).
void validate(const GraphView& graph);

/// Returns the mean length of the edges, each counted once, in the unit of the positions; 0 if there are none. The
/// graph must be valid. Takes O(#V + #E).
[[nodiscard]] double mean_edge_length(const GraphView& graph);

/// Returns the graph without some of its edges. `build` of its view gives an index whose searches do not cross them.
///
/// graph  valid (see `validate`), which is not checked.
/// edges  #cut by 2: the two ends of each edge, in either order; repeats are allowed.
///
/// Throws Error{InvalidOption} if the number of ends is odd, Error{VertexOutOfRange}, and Error{InvalidOption} if two
/// vertices are not joined by an edge; the message names the row of `edges`. Takes O(#E + #cut log(valence)).
[[nodiscard]] Adjacency cut_edges(const AdjacencyView& graph, const IndicesView& edges);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
