// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshhood/reference.h"

namespace meshhood::inline v0_1 {

/// Gives the exact index access to the search itself, and tests access to rare states.
struct ReferenceAccess {
  /// Returns the neighborhood in the order of the search, valid until the next call. `squared_radius` is the result of
  /// the function of this name. Nothing is checked.
  [[nodiscard]] static std::span<const VertexId> search(ReferenceSearcher& searcher, VertexId v, double squared_radius);

  /// Makes a searcher of a graph, which must be valid.
  [[nodiscard]] static ReferenceSearcher make(const GraphView& graph);

  /// No later search enters `v`, which is in no ball from now on. It must not be the vertex of a query.
  static void remove(ReferenceSearcher& searcher, VertexId v);

  /// Continues as if there had been `queries` queries.
  static void set_query(ReferenceSearcher& searcher, std::uint32_t queries);
};

}  // namespace meshhood::inline v0_1
