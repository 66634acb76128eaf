// SPDX-License-Identifier: MIT
#include "meshhood/edge_search.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/ranges.h"
#include "exact/bound_index.h"
#include "exact/query/arguments.h"
#include "exact/query/path_search.h"
#include "exact/query/ring_search.h"
#include "exact/query/vertex_rings.h"
#include "exact/search/vertex_bfs.h"
#include "exact/vertex_set.h"
#include "shared/distance.h"

namespace meshhood {

/// The scratch memory of an edge searcher.
struct EdgeSearcher::State {
  BoundIndex index;
  std::shared_ptr<KeptGraph> graph;
  const Kernels* kernels;
  std::optional<PathSearch> paths;  // made by the first search: it needs the lengths of all edges
  RingSearch rings;
  std::optional<VertexRings> by_vertex;  // for a graph unlike a surface, instead of `rings`
  VertexSet answer;                      // of `rings`
  std::vector<VertexRange> ranges;       // of the last call of that name

  explicit State(const Index& owner)
      : index(owner),
        graph(IndexAccess::share_graph(owner)),
        kernels(&meshhood::kernels(best_isa())),
        rings(*index, *kernels),
        answer(*index) {}

  void check(VertexId v, double radius) const {
    index.check_current();
    check_query(v, index->vertex_count(), radius);
  }

  /// Finds the vertices, those that are ignored included.
  void search(VertexId v, double radius) {
    check(v, radius);
    if (!paths) paths.emplace(*index, *graph);
    const std::uint32_t slot = index->slot[v];
    paths->run(index->leaf_begin[leaf_of(slot)] + lane_of(slot), radius);
  }

  /// The rings up to ring `k`, added to two empty lists.
  void rings_by_vertex(VertexId v, std::size_t k, std::vector<VertexId>& ids, std::vector<std::size_t>& sizes);
  void rings_by_leaf(VertexId v, std::size_t k, std::vector<VertexId>& ids, std::vector<std::size_t>& sizes);

  /// Calls `f(path)` for the vertices of `found` that are not ignored.
  template <class F>
  void for_each(std::span<const Path> found, F&& f) const {
    for (const Path& path : found) {
      if (!index->is_ignored_at(path.end)) f(path);
    }
  }
};

EdgeSearcher::EdgeSearcher(const Index& index) : state_(std::make_unique<State>(index)) {}

void EdgeSearcher::rebind(const Index& index) {
  if (state_ && state_->index.is_of(index)) {
    state_->index = BoundIndex(index);
    state_->graph = IndexAccess::share_graph(index);
    state_->paths.reset();
    state_->by_vertex.reset();  // it borrows the graph
  } else {
    *this = EdgeSearcher(index);
  }
}

std::size_t EdgeSearcher::vertex_count() const { return state_->index->vertex_count(); }

std::span<const VertexId> EdgeSearcher::permutation() const& {
  const std::span<const VertexId> padded = state_->index->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void EdgeSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  state_->search(v, radius);
  const std::span<const Path> found = state_->paths->found_in_order();
  out.reserve(found.size());
  out.clear();
  state_->for_each(found, [&](const Path& path) { out.push_back(state_->index->id(path.end)); });
}

void EdgeSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  state_->search(v, radius);
  const std::span<const Path> found = state_->paths->found_in_order();
  // Before either changes: if this throws, neither has changed.
  out.reserve(found.size());
  distances.reserve(found.size());
  out.clear();
  distances.clear();
  state_->for_each(found, [&](const Path& path) {
    out.push_back(state_->index->id(path.end));
    distances.push_back(path.length);
  });
}

std::size_t EdgeSearcher::count(VertexId v, double radius) {
  state_->search(v, radius);
  std::size_t count = 0;
  state_->for_each(state_->paths->found(), [&](const Path&) { ++count; });
  return count;
}

std::span<const VertexRange> EdgeSearcher::ranges(VertexId v, double radius) & {
  state_->search(v, radius);
  std::vector<VertexRange>& ranges = state_->ranges;
  std::vector<VertexId> positions;
  state_->for_each(state_->paths->found(),
                   [&](const Path& path) { positions.push_back(static_cast<VertexId>(path.end)); });
  std::sort(positions.begin(), positions.end());
  ranges.clear();
  for (const VertexId i : positions) append_to(ranges, i);
  return ranges;
}

void EdgeSearcher::State::rings_by_vertex(VertexId v, std::size_t k, std::vector<VertexId>& ids,
                                          std::vector<std::size_t>& sizes) {
  if (!by_vertex) by_vertex.emplace(*index, *graph);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  by_vertex->run(index->slot[v], static_cast<std::uint32_t>(std::min(k, kMost)));
  for (const std::vector<std::uint32_t>& ring : by_vertex->rings()) {
    for (const std::uint32_t place : ring) ids.push_back(index->id(place));
    sizes.push_back(ids.size());
  }
}

void EdgeSearcher::State::rings_by_leaf(VertexId v, std::size_t k, std::vector<VertexId>& ids,
                                        std::vector<std::size_t>& sizes) {
  std::vector<LeafSubset> found;
  for (rings.start(index->slot[v]); !rings.ring().empty(); rings.advance()) {
    found.clear();
    for (const LeafSubset& subset : rings.ring()) {
      const LaneMask lanes = subset.lanes & ~index->ignored_lanes(subset.leaf);
      if (lanes != 0) found.push_back({subset.leaf, lanes});
    }
    answer.assign(found);
    append_ids(answer, *index, *kernels, ids);
    sizes.push_back(ids.size());
    if (sizes.size() > k) break;
  }
}

void EdgeSearcher::rings(VertexId v, std::size_t k, std::vector<VertexId>& out, std::vector<std::size_t>& counts) {
  State& state = *state_;
  state.check(v, 0);
  std::vector<VertexId> ids;
  std::vector<std::size_t> sizes;
  if (is_unlike_a_surface(*state.index)) {
    state.rings_by_vertex(v, k, ids, sizes);
  } else {
    state.rings_by_leaf(v, k, ids, sizes);
  }
  out = std::move(ids);
  counts = std::move(sizes);
}

}  // namespace meshhood
