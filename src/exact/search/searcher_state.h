// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"
#include "exact/search/descent.h"
#include "exact/search/leaf_bfs.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/local_minima.h"
#include "exact/search/other_components.h"
#include "exact/search/query.h"
#include "exact/search/search_limits.h"
#include "exact/search/vertex_bfs.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// The scratch memory of a searcher, and the outline of a query.
struct Searcher::State {
  std::shared_ptr<const IndexView> index;  // shared, so that `refit` leaves it as it is
  const Kernels* kernels;
  SearchLimits limits;
  RadiusBounds bounds;
  Descent descent;
  LeafTraversal traversal;
  OtherComponents other_components;
  LeafBfs leaf_bfs;
  FailureCache failures;
  std::vector<LocalMinimum> minima;
  VertexSet answer;
  std::optional<VertexBfs> vertex_bfs;  // answers instead of `search` where the graph is unlike a surface
  bool was_proved = false;              // whether the last answer was found by `subtract_other_components`

  State(std::shared_ptr<const IndexView> view, Isa isa)
      : index(std::move(view)),
        kernels(&meshhood::kernels(isa)),
        bounds(index->frame, 0),
        descent(*index, *kernels),
        traversal(*index, *kernels),
        other_components(*index, *kernels),
        leaf_bfs(*index),
        failures(index->leaf_count()),
        answer(*index) {}

  /// Refills `answer` with the neighborhood, and returns the position of `v`.
  Point search(VertexId v, double radius);

  /// Refills `out` with the ids of `answer`.
  void write_answer(std::vector<VertexId>& out) const;

  /// Forgets earlier queries, so that the order of the next answer does not depend on them.
  void forget() { failures.clear(); }

 private:
  bool prove(const Query& query);
  bool subtract_other_components(const Query& query);
  void add_intersecting_leaves(const Query& query);
};

/// Access to the parts of a searcher, for the batch and for tests.
struct SearcherAccess {
  using State = Searcher::State;
  static Searcher::State& state(Searcher& searcher) { return *searcher.state_; }
  static void set_isa(Searcher& searcher, Isa isa) {
    searcher.state_ = std::make_unique<Searcher::State>(searcher.state_->index, isa);
  }
};

}  // namespace meshhood
