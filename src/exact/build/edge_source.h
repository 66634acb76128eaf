// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

#include "base/adjacency.h"

namespace meshhood::inline v0_1 {

/// Borrows the edges of a mesh, from its polygons or from its graph, which must be valid. A build reads them once, in
/// any order, so it needs no graph of a mesh.
class EdgeSource {
 public:
  explicit EdgeSource(const FacesView& faces) : source_(faces) {}
  explicit EdgeSource(const AdjacencyView& graph) : source_(graph) {}

  /// Returns the number of polygons, or of rows.
  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& source) { return source.size(); }, source_);
  }

  /// Calls `f(v, w)` for the edges of the polygons or rows `begin .. end - 1`: for every edge at least once, in either
  /// direction.
  template <class F>
  void for_each(std::size_t begin, std::size_t end, F&& f) const {
    if (const auto* const faces = std::get_if<FacesView>(&source_)) {
      for_each_side(*faces, begin, end, f);
      return;
    }
    const AdjacencyView& graph = *std::get_if<AdjacencyView>(&source_);
    for (std::size_t v = begin; v < end; ++v) {
      for (const VertexId w : graph[v]) {
        if (w > v) f(static_cast<VertexId>(v), w);
      }
    }
  }

 private:
  std::variant<FacesView, AdjacencyView> source_;
};

}  // namespace meshhood::inline v0_1
