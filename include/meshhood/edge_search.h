// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/search.h"

namespace meshhood {

/// Finds vertices by their path distance along the edges, with an `Index`. The *path distance* of a vertex `w` from `v`
/// is the least length of a path of edges from `v` to `w`. The length of an edge is the distance of its ends (see
/// `distance`); the length of a path is the sum of those of its edges, added in double in the order of the path. The
/// rounded sum never decreases if a summand grows, so the search finds the least sum to the last bit, as does the
/// algorithm of Dijkstra (1959).
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex whose path distance is exactly `radius` is inside.
///
/// An answer depends on the index, the vertex and the radius alone. Its ids ascend by path distance, those
/// of equal distance by their places in index order.
///
/// O(n log n) for a result of n vertices. The first search of an index takes O(#V + #E): it computes the lengths of all
/// edges, which the index keeps for all searchers (80 bytes a vertex with six edges).
///
/// Use one object per thread: it owns 8 bytes a vertex, and scratch memory for its largest result. It shares the memory
/// of the index, which may be moved, refitted or destroyed meanwhile: answers are those of the index as it was. It is a
/// `NeighborhoodSearcher`.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption}; arguments are then unchanged.
class EdgeSearcher {
 public:
  explicit EdgeSearcher(const Index& index);
  explicit EdgeSearcher(const Index&&) = delete;

  /// Goes on with `index`: the answers are then those of a new searcher. After `refit_in_place`, the next search along
  /// the edges takes O(#V + #E), as the first of an index does.
  void rebind(const Index& index);
  void rebind(const Index&&) = delete;

  /// #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// The permutation of the index.
  [[nodiscard]] std::span<const VertexId> permutation() const&;
  [[nodiscard]] std::span<const VertexId> permutation() const&& = delete;

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> neighborhood(VertexId v, double radius) {
    std::vector<VertexId> out;
    neighborhood(v, radius, out);
    return out;
  }

  /// out     replaced, its capacity reused: the vertices whose path distance is at most `radius`, ascending by path
  ///         distance, `v` first.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);

  /// Also returns the path distance of each vertex, in the order of the ids.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// The number of these vertices.
  [[nodiscard]] std::size_t count(VertexId v, double radius);

  /// The same vertices as ranges of the index order. Ascending, with gaps between them, none empty; valid until the
  /// next call.
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius) &;

  /// The vertices that at most `k` edges separate from `v`, ring by ring: ring `i` has those whose shortest path has
  /// exactly `i` edges.
  ///
  /// out     replaced: the ids, each ring in index order.
  /// counts  replaced: the first `counts[i]` ids are at most `i` edges away. It ends with the last ring that is not
  ///         empty, or with ring `k`; it is empty if `v` is a wall.
  /// O(n) for a result of n vertices.
  void rings(VertexId v, std::size_t k, std::vector<VertexId>& out, std::vector<std::size_t>& counts);

 private:
  struct State;
  detail::Owner<State> state_;
};

}  // namespace meshhood
