// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/search.h"

#include "index/layout.h"
#include "search/answer.h"
#include "search/cover.h"
#include "search/flood.h"
#include "search/leaf_walk.h"
#include "search/simd.h"

namespace meshhood {

/// What a radius is compared by. Kept from one query to the next, for most ask with the same.
struct RadiusBounds {
  double radius;
  LeafBounds leaf;
  TreeBounds tree;

  RadiusBounds(const Frame& frame, double at) : radius(at), leaf(at), tree(frame, at) {}
};

struct Searcher::State {
  const IndexStorage* index;
  const Kernels* kernels;
  LeafWalk walk;
  Cover cover;
  Flood flood;
  RadiusBounds bounds;
  Answer answer;
  bool covered = false;  // the last answer: by the cover, not by the flood

  State(const IndexStorage& storage, Isa isa)
      : index(&storage),
        kernels(&meshhood::kernels(isa)),
        walk(storage, *kernels),
        cover(storage, *kernels),
        flood(storage),
        bounds(storage.frame, 0) {}

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
