// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"
#include "exact/search/descent.h"
#include "exact/search/few_leaves.h"
#include "exact/search/group_states.h"
#include "exact/search/home_marks.h"
#include "exact/search/leaf_bfs.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/loose_pieces.h"
#include "exact/search/other_components.h"
#include "exact/search/query.h"
#include "exact/search/reached_components.h"
#include "exact/search/search_limits.h"
#include "exact/search/vertex_bfs.h"
#include "exact/search/vertex_set.h"
#include "exact/search/waves.h"
#include "simd/kernels.h"

namespace meshhood {

/// The scratch memory of a searcher, and the outline of a query.
struct Searcher::State {
  std::shared_ptr<const IndexView> index;  // shared, so that `refit` leaves it as it is
  const Kernels* kernels;
  SearchLimits limits;
  RadiusBounds bounds;
  GroupStates states;
  Waves waves;
  Descent descent;
  HomeMarks marks;
  LoosePieces loose;
  LeafTraversal traversal;
  OtherComponents other_components;
  ReachedComponents reached_components;
  FewLeaves few_leaves;
  LeafBfs leaf_bfs;
  SearchMemory memory;
  std::vector<LeafSubset> surface_leaves;  // with their vertices in the ball; they have others outside
  VertexSet answer;
  std::span<const VertexId> ids;  // the answer instead, if `vertex_bfs` has found it
  VertexBfs vertex_bfs;
  std::size_t leaf_visits = 0;  // that the last search has taken, about
  bool was_outward = false;     // whether the last answer was found by `search_outward`
  bool was_united = false;      // and whether that has united what it reached

  State(std::shared_ptr<const IndexView> view, Isa isa)
      : index(std::move(view)),
        kernels(&meshhood::kernels(isa)),
        bounds(index->frame, 0),
        states(*index),
        waves(*index, *kernels),
        descent(*index, *kernels),
        marks(*index),
        loose(*index, *kernels),
        traversal(*index, *kernels),
        other_components(*index, *kernels),
        reached_components(*index, *kernels),
        few_leaves(*index, *kernels),
        leaf_bfs(*index),
        answer(*index),
        vertex_bfs(*index) {}

  /// Finds the neighborhood. Returns whether it is in `ids`; if not, it is in `answer`.
  [[nodiscard]] bool is_found_over_vertices(VertexId v, double radius);

  /// By the searches over leaves: refills `answer` with the neighborhood, or `ids` if `vertex_bfs` knows that its copy
  /// of the graph is numbered by rows.
  void search(VertexId v, double radius);

  [[nodiscard]] Point center_of(VertexId v) const {
    const std::uint32_t slot = index->slot[v];
    return index->position(leaf_of(slot), lane_of(slot));
  }

  /// Tells the search over vertices how long the last search, which has found `size` vertices, has taken.
  void record(VertexId v, double radius, std::size_t size) { vertex_bfs.record(v, radius, size, leaf_visits); }

  /// Refills `out` with the ids of `answer`.
  void write_answer(std::vector<VertexId>& out) const;

  /// Forgets earlier queries, so that the order of the next answer does not depend on them.
  void forget() { memory.clear(); }

 private:
  friend class SearchSteps;  // bench/search_steps.cpp times the steps one by one

  /// A node over the query vertex.
  struct Home {
    std::size_t level;
    NodeId node;
  };

  [[nodiscard]] bool search_few_leaves(std::uint32_t slot, const Point& center, bool is_near);
  [[nodiscard]] bool is_answer_small();
  void search_outward(const Query& query);
  bool remove_other_components(const Query& query);
  void record_search();
  void reach(const Query& query);
  [[nodiscard]] Home home_of(const Query& query, double ratio) const;
  bool reach_from(const Home& home, const Query& query, std::size_t limited_above);
  void find_surface_leaves(const Query& query);
  void settle(LeafId leaf, bool is_whole);
  void mark_home(const Query& query);
  void add_reached();
};

/// Access to the parts of a searcher, for the batch and for tests.
struct SearcherAccess {
  using State = Searcher::State;
  static Searcher::State& state(Searcher& searcher) { return *searcher.state_; }
  static void set_isa(Searcher& searcher, Isa isa) {
    searcher.state_ = std::make_unique<Searcher::State>(searcher.state_->index, isa);
    searcher.state_->vertex_bfs.answer_none();
  }
};

}  // namespace meshhood
