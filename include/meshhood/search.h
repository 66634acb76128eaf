// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// Vertices in index order: `Index::permutation()[begin] .. [end - 1]`.
struct VertexRange {
  VertexId begin;
  VertexId end;

  friend bool operator==(const VertexRange&, const VertexRange&) = default;
};

/// Asks an `Index` for exact neighborhoods: the connected component that holds `v` in the graph induced by the ball of
/// `radius` around `v`. Every call gives exactly what `ReferenceSearcher` gives, on every processor.
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` counts.
///
/// Cost is about that of the leaves at the rim of the answer, not of the answer or the mesh; on folded surfaces that of
/// the leaves of the answer. Nothing is allocated once the buffers have grown. Owns the scratch memory (22 bytes a
/// leaf): one object a thread. The index must outlive it, and may be moved meanwhile.
///
/// Throws Error{VertexOutOfRange, InvalidRadius}; arguments are then unchanged.
class Searcher {
 public:
  explicit Searcher(const Index& index);
  Searcher(Searcher&&) noexcept;
  Searcher& operator=(Searcher&&) noexcept;
  ~Searcher();

  /// out     refilled, capacity reused: ids in no stated order, without duplicates, `v` included.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);

  /// The same with the distance of each vertex from `v` (see `distance`), in the same order.
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// The same as ranges in index order, without copying ids. In no stated order, disjoint, none empty; valid until the
  /// next call.
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);

  /// How many vertices the neighborhood has.
  [[nodiscard]] std::size_t count(VertexId v, double radius);

 private:
  friend struct SearcherAccess;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meshhood
