// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// The exact neighborhood by breadth-first search on the graph of the mesh: the yardstick of sec. 4.3 for what is right
/// and for how long it takes. It is meant to be the fastest breadth-first search one can write: positions and visited
/// stamp of a vertex share 16 bytes, nothing is allocated and nothing cleared per query, and what the search will soon
/// look at is fetched ahead.
///
/// Owns what it searches: 20 bytes a vertex (36 where the positions are double) and, unless it was given, the graph.
/// Each query writes to it, so one object a thread.
class ReferenceSearcher {
 public:
  /// Throws Error{InvalidMesh, TooLarge}.
  explicit ReferenceSearcher(const MeshView& mesh);

  /// The same on a graph given directly, whose adjacency must outlive the searcher.
  explicit ReferenceSearcher(const GraphView& graph);

  ReferenceSearcher(ReferenceSearcher&&) noexcept;
  ReferenceSearcher& operator=(ReferenceSearcher&&) noexcept;
  ~ReferenceSearcher();

  /// The vertices of the connected component that holds `v` in the graph induced by the ball of `radius` around `v`.
  ///
  /// v       in [0, #V).
  /// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` counts.
  /// out     refilled, capacity reused: ids in the order the search reaches them, `v` first, no duplicates.
  ///
  /// O(vertices and edges of the answer); nothing is allocated but for `out`.
  /// Throws Error{VertexOutOfRange, InvalidRadius}; `out` is then unchanged.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);

  /// The graph that is searched. Lives as long as the searcher.
  [[nodiscard]] AdjacencyView adjacency() const;

 private:
  friend struct ReferenceAccess;

  struct State;
  std::unique_ptr<State> state_;
};

/// One exact neighborhood of a mesh, for whoever asks once: as `ReferenceSearcher`, which it builds and throws away.
/// O(#V + #corners log(valence)), whatever the radius.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidMesh, TooLarge}.
[[nodiscard]] std::vector<VertexId> exact_neighborhood(const MeshView& mesh, VertexId v, double radius);

/// Every vertex within `radius` of `v` in space, by a scan of all positions (sec. 4.3). Wrong as a neighborhood: it
/// takes whatever else of the surface passes through the ball.
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` counts.
/// out     refilled, capacity reused: ids ascending, `v` included.
/// The coordinates are taken as valid. O(#V).
///
/// Throws Error{VertexOutOfRange, InvalidRadius}; `out` is then unchanged. Where memory runs out, it has a part of the
/// answer.
void vertices_in_ball(const PositionsView& positions, VertexId v, double radius, std::vector<VertexId>& out);

}  // namespace meshhood
