// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "exact/node_search.h"
#include "exact/search/searcher_state.h"
#include "support/search_case.h"

/// The steps of the outward search, for tests of each against brute force.
namespace meshhood::test {

/// The node over a leaf on each level, as far as there is one.
[[nodiscard]] inline std::vector<NodeId> nodes_above(const IndexView& index, LeafId leaf) {
  std::vector<NodeId> nodes;
  for (NodeId node = leaf; node != kNoNode; node = index.parents[node / kFanOut]) nodes.push_back(node);
  return nodes;
}

/// The number of groups up to the end of a level.
[[nodiscard]] inline std::size_t end_of_level(const IndexView& index, std::size_t level) {
  return index.tree[level].first_group + index.tree[level].groups;
}

/// The caller's ids of the vertices of the nodes of `set` in a group, unsorted.
inline void append_vertices(const IndexView& index, std::uint32_t group, NodeSet set, Ids& ids) {
  const GroupRecord& record = index.records[group];
  for_each_node(set, [&](unsigned i) {
    for (std::size_t v = record.begin[i]; v < record.begin[i + 1]; ++v) ids.push_back(index.id(v));
  });
}

/// Those of `ids` that are in the ball, ascending.
[[nodiscard]] inline Ids in_ball(const SearchCase& c, Ids ids) {
  std::erase_if(ids, [&](std::uint32_t w) { return !c.is_in_ball(w); });
  return sorted(std::move(ids));
}

/// The components of the ball, each ascending; that of the query vertex first.
[[nodiscard]] inline std::vector<Ids> components_of_ball(const SearchCase& c) {
  std::vector<Ids> components{c.neighborhood()};
  std::vector<bool> is_known(c.oracle.size());
  for (const std::uint32_t w : components[0]) is_known[w] = true;
  for (const std::uint32_t w : c.ball()) {
    if (is_known[w]) continue;
    components.push_back(c.component_in_ball(w));
    for (const std::uint32_t u : components.back()) is_known[u] = true;
  }
  return components;
}

[[nodiscard]] inline double squared_distance_of(const SearchCase& c, std::uint32_t w) {
  return squared_distance(c.index.position(c.leaf_of_id(w), lane_of(c.index.slot[w])), c.query.center());
}

/// Calls `f(case, state)` after outward searches for queries on small meshes of `family`, with and without limits.
/// Returns the number of queries that all steps of the outward search have answered.
template <class F>
std::size_t for_each_outward_search(const Family& family, std::size_t meshes, std::size_t vertices_per_mesh, F&& f) {
  std::size_t searches = 0;
  for (std::uint64_t seed = 0; seed < meshes; ++seed) {
    const TestMesh mesh = make_mesh(family, seed, seed == 0 ? 1500 : std::min<std::size_t>(draw_size(seed), 400));
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    std::vector<Searcher> searchers = searchers_of(index);
    Random random(seed);
    for (std::size_t i = 0; i < vertices_per_mesh; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        SearcherAccess::State& state = SearcherAccess::state(searchers[searches % searchers.size()]);
        state.limits.enabled = random.below(2) == 0;
        static_cast<void>(state.search(v, radius));
        if (!state.was_outward || state.was_united) continue;
        const Query query(*state.index, v, RadiusBounds(state.index->frame, radius));
        f(SearchCase{mesh, oracle, *state.index, query, *state.kernels}, state);
        ++searches;
      }
    }
  }
  return searches;
}

}  // namespace meshhood::test
