// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/searcher.h"

namespace meshhood {

/// Finds exact neighborhoods by an `Index`: the part of the mesh inside the ball of `radius` around `v` that is
/// connected to `v` within the ball. More precisely, a neighborhood is the component with `v` of the graph induced by
/// the vertices in the ball. The result is the same set as that of `ReferenceSearcher`, on every processor.
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` is inside.
///
/// An answer depends on the index, the vertex and the radius alone. Its ids are in index order: ascending places of the
/// permutation of the index. If the mesh was renumbered by `reorder`, they ascend.
///
/// The cost grows with the number of leaves that the surface of the ball intersects, not with the size of the result or
/// the mesh; on folded surfaces it grows with the number of leaves of the result. Nothing is allocated once the buffers
/// have grown.
///
/// Use one object per thread: it owns scratch memory, 23 to 30 bytes per leaf. It shares the memory of the index, which
/// may be moved, refitted or destroyed meanwhile: answers are those of the index as it was.
///
/// On a graph unlike a surface (with a vertex that has very many neighbors, or with random edges), the cost is that of
/// `ReferenceSearcher`, and each searcher owns 20 bytes per vertex more (36 for double). All of them share a copy of
/// the graph, which the index keeps: 8 bytes per vertex and 12 for each of its neighbors, which `Index::bytes` does not
/// count. The query that makes it takes O(#V + #E).
///
/// Throws Error{VertexOutOfRange, InvalidRadius}; arguments are then unchanged.
class Searcher {
 public:
  explicit Searcher(const Index& index);
  explicit Searcher(const Index&&) = delete;
  Searcher(Searcher&&) noexcept;
  Searcher& operator=(Searcher&&) noexcept;
  ~Searcher();

  /// #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// The permutation of the index.
  [[nodiscard]] std::span<const VertexId> permutation() const;

  /// out     replaced, its capacity reused: ids in index order, without duplicates, `v` included.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from `v` (see `distance`), in the order of the ids.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// The neighborhood as ranges of the index order, without copying ids. Ascending, with gaps between them, none empty;
  /// valid until the next call. See `visit` and `reduce` in searcher.h.
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);

  /// The number of vertices of the neighborhood.
  [[nodiscard]] std::size_t count(VertexId v, double radius);

 private:
  friend struct SearcherAccess;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meshhood
