// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/search.h"

#include "exact/layout.h"
#include "exact/search/ball_search.h"
#include "exact/search/leaf_bfs.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// What a radius is compared by. Kept from one query to the next, for most ask with the same.
struct RadiusBounds {
  double radius;
  LeafBounds leaf;
  TreeBounds tree;

  RadiusBounds(const Frame& frame, double at) : radius(at), leaf(at), tree(frame, at) {}
};

struct Searcher::State {
  const IndexView* index;
  const Kernels* kernels;
  LeafTraversal walk;
  BallSearch ball_search;
  LeafBfs leaf_bfs;
  RadiusBounds bounds;
  VertexSet answer;
  bool by_ball_search = false;  // the last answer: by the cover, not by the flood

  State(const IndexView& view, Isa isa)
      : index(&view),
        kernels(&meshhood::kernels(isa)),
        walk(view, *kernels),
        ball_search(view, *kernels),
        leaf_bfs(view),
        bounds(view.frame, 0) {}

  /// Leaves the neighborhood in `answer` and returns where `v` is.
  Point search(VertexId v, double radius);

  /// The ids of `answer`.
  void refill(std::vector<VertexId>& out) const;
};

/// The door to what a searcher is made of, for tests that force what is rare.
struct SearcherAccess {
  using State = Searcher::State;
  static Searcher::State& state(Searcher& searcher) { return *searcher.state_; }
  static void set_isa(Searcher& searcher, Isa isa) {
    searcher.state_ = std::make_unique<Searcher::State>(*searcher.state_->index, isa);
  }
};

}  // namespace meshhood
