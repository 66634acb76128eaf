// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/search/component.h"
#include "exact/search/leaf_bfs.h"
#include "exact/search/query.h"
#include "exact/search/reach.h"
#include "exact/search/vertex_bfs.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Finds the exact neighborhood of a vertex: the outline of the query, and its scratch memory.
struct StraightSearch {
  BoundIndex index;
  std::shared_ptr<KeptGraph> graph;  // of odd graphs
  const Kernels* kernels;
  RadiusBounds bounds;
  bool is_odd;
  VertexBfs vertex_bfs;
  LeafBfs leaf_bfs;
  Reach reach;
  Component component;
  VertexSet answer;

  StraightSearch(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Isa isa)
      : index(std::move(bound)),
        graph(std::move(kept)),
        kernels(&meshhood::kernels(isa)),
        bounds(index->frame, 0),
        is_odd(meshhood::is_odd(*index)),
        vertex_bfs(*index, *graph),
        leaf_bfs(*index, *kernels),
        reach(*index, *kernels),
        component(*index, *kernels),
        answer(*index) {}

  /// Goes on with the present state of the same index.
  void rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept);

  /// Refills `answer` with the neighborhood.
  void search(VertexId v, double radius);

  /// The way that answers a query. It depends on index, vertex and radius alone.
  enum class Way { VertexBfs, Wall, Alone, LeafBfs, Component };
  Way way = Way::VertexBfs;  // of the last query; its answer is not aligned to leaves after `VertexBfs`

 private:
  void find(VertexId v, std::uint32_t slot);
  [[nodiscard]] bool is_alone(std::uint32_t slot) const;
  [[nodiscard]] bool is_tiny() const;
  [[nodiscard]] bool is_small(const Leaf& leaf) const;
  [[nodiscard]] bool is_mostly_open() const;
};

}  // namespace meshhood::inline v0_1
