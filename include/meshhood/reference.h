// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/search.h"
#include "meshhood/vertex.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Finds exact neighborhoods by breadth-first search on the graph of the mesh: the reference of sec. 4.3 for
/// correctness and speed. It is meant to be the fastest breadth-first search possible: the position of a vertex and the
/// mark of the query that visited it share 16 bytes, nothing is cleared between queries, and memory is prefetched.
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` is inside.
///
/// A query costs O(vertices and edges of the result). Only the result is allocated.
///
/// Use one object per thread. It owns a copy of the positions, 20 bytes per vertex (36 for double), and the graph
/// unless that was given.
///
/// Throws Error{VertexOutOfRange, InvalidRadius}; arguments are then unchanged.
class ReferenceSearcher {
 public:
  /// Throws Error{InvalidMesh, TooLarge}. Takes O(#V + #corners log(valence)).
  explicit ReferenceSearcher(const MeshView& mesh);

  /// Searches a graph given directly. Its adjacency must outlive the searcher. Throws Error{InvalidMesh, TooLarge}.
  explicit ReferenceSearcher(const GraphView& graph);

  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Returns an empty permutation: ranges are in the caller's order.
  [[nodiscard]] std::span<const VertexId> permutation() const { return {}; }

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> neighborhood(Vertex v, double radius) {
    std::vector<VertexId> out;
    neighborhood(v, radius, out);
    return out;
  }

  /// out     replaced, its capacity reused: ids in the order of the search, `v` first, no duplicates.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from `v` (see `distance`), in the order of the ids.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// Returns the neighborhood as disjoint, nonempty ranges of ids in search order; valid until the next call.
  [[nodiscard]] std::span<const VertexRange> ranges(Vertex v, double radius) &;

  /// Returns the number of vertices of the neighborhood.
  [[nodiscard]] std::size_t count(Vertex v, double radius);

  /// Returns the graph that is searched. It lives as long as the searcher.
  [[nodiscard]] AdjacencyView adjacency() const&;
  [[nodiscard]] AdjacencyView adjacency() const&& = delete;

 private:
  friend struct ReferenceAccess;

  struct State;
  explicit ReferenceSearcher(std::unique_ptr<State> state);

  detail::Owner<State> state_;
};

/// Finds every vertex within `radius` of `v` in space, by a scan of all positions (sec. 4.3). This is not a
/// neighborhood: it contains vertices of other parts of the surface that pass through the ball.
///
/// Arguments and errors are those of `ReferenceSearcher`. Each query costs O(#V). The coordinates must be valid (see
/// `validate`) and outlive the searcher. Use one object per thread.
class BallSearcher {
 public:
  explicit BallSearcher(const PositionsView& positions) : positions_(positions) {}

  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const { return positions_.size(); }

  /// Returns an empty permutation: ranges are in the caller's order.
  [[nodiscard]] std::span<const VertexId> permutation() const { return {}; }

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> neighborhood(Vertex v, double radius) {
    std::vector<VertexId> out;
    neighborhood(v, radius, out);
    return out;
  }

  /// out     replaced, its capacity reused: ids ascending, `v` included.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from `v` (see `distance`), in the order of the ids.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// Returns the vertices as ascending ranges of ids, disjoint, none empty; valid until the next call.
  [[nodiscard]] std::span<const VertexRange> ranges(Vertex v, double radius) &;

  /// Returns the number of vertices in the ball.
  [[nodiscard]] std::size_t count(Vertex v, double radius);

 private:
  PositionsView positions_;
  std::vector<VertexRange> ranges_;
};

/// Returns one exact neighborhood of a mesh, by a `ReferenceSearcher` that is built for this call; for more, keep a
/// searcher or an index. Ids are in the order of the search, `v` first; a vertex at exactly `radius` is inside. Takes
/// O(#V + #corners log(valence)), whatever the radius.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidMesh, TooLarge}.
[[nodiscard]] std::vector<VertexId> exact_neighborhood(const MeshView& mesh, Vertex v, double radius);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
