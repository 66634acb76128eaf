// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "exact/node_search.h"
#include "exact/search/component.h"
#include "support/search_case.h"

/// The steps of the outward search, for tests of each against brute force.
namespace meshhood {

struct ReachAccess {
  /// As `Reach::run` does, but begins with the node of `level` over the query vertex.
  static void run(Reach& reach, const Query& query, std::size_t level) {
    Reach::Home home{0, query.leaf()};
    for (; home.level < level; ++home.level) home.node = reach.index_->parents[home.node / kFanOut];
    static_cast<void>(reach.reach_from(home, query, level));
    reach.find_surface_leaves(query);
  }
};

struct HomeMarksAccess {
  /// Marks what `HomeMarks::spread` begins with, and what is linked with that within a group or from a surface leaf,
  /// but does not spread the marks further: nearly all is open.
  static void begin(HomeMarks& marks, const Query& query, Reach& reach) {
    marks.states_ = &reach.states();
    marks.leaves_.clear();
    for (const std::uint32_t group : reach.groups()) reach.states()[group].home = 0;
    marks.begin(query, reach);
    for (const std::uint32_t group : reach.groups()) {
      GroupState& state = reach.states()[group];
      state.home = reachable_nodes(marks.index_->records[group].linked, state.home, state.whole);
      marks.leaves_.add(group, state.home);
    }
    marks.keep_open(reach.groups());
    const std::span<const LeafSubset> leaves = reach.surface_leaves();
    marks.lanes_.resize(leaves.size() + 1);
    marks.open_places_.clear();
    for (std::size_t place = 0; place < leaves.size(); ++place) marks.mark_leaf(query, leaves[place], place);
  }
};

namespace test {

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

/// The caller's ids of some of the vertices of a leaf.
inline void append_vertices(const SearchCase& c, LeafId leaf, LaneMask lanes, Ids& ids) {
  for_each_lane(lanes, [&](unsigned lane) { ids.push_back(c.id(leaf, lane)); });
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

/// The steps, as a searcher has them: used again for each query.
struct OutwardSearch {
  OutwardSearch(const IndexView& index, const Kernels& kernels)
      : reach(index, kernels), marks(index, kernels), open(index, kernels), component(index, kernels), answer(index) {}

  /// The marked vertices, unsorted.
  [[nodiscard]] Ids marked(const SearchCase& c) const {
    Ids ids;
    for (const std::uint32_t group : reach.groups()) append_vertices(c.index, group, reach.states()[group].home, ids);
    const std::span<const LeafSubset> leaves = reach.surface_leaves();
    for (std::size_t i = 0; i < leaves.size(); ++i) append_vertices(c, leaves[i].leaf, marks.lanes(i), ids);
    return ids;
  }

  /// The answer of `component`, in its order.
  [[nodiscard]] Ids found(const Query& query, const IndexView& index) {
    answer.clear();
    component.mark(query, reach);
    component.complete(reach, answer);
    Ids ids;
    answer.for_each([&](std::size_t v) { ids.push_back(index.id(v)); });
    return ids;
  }

  Reach reach;
  HomeMarks marks;
  OpenElements open;
  Component component;
  VertexSet answer;
};

/// Calls `f(case, search)` after `search.reach` has begun on each level in turn, for queries on one mesh. Returns the
/// number of calls.
///
/// draw  returns the next query: vertex and radius
template <class Draw, class F>
std::size_t for_each_level(const TestMesh& mesh, std::size_t queries, Draw&& draw, F&& f) {
  if (mesh.size() == 0) return 0;
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const std::vector<Isa> isas = available_isas();
  std::deque<OutwardSearch> searches;
  for (const Isa isa : isas) searches.emplace_back(index, kernels(isa));
  std::size_t calls = 0;
  for (std::size_t i = 0; i < queries; ++i) {
    for (const auto& [v, radius] : draw(oracle)) {
      const Query query(index, v, RadiusBounds(index.frame, radius));
      // The leaf of the query vertex would be no node of the search.
      if (!index.leaves[query.leaf()].connected) continue;
      for (std::size_t level = 0; level < nodes_above(index, query.leaf()).size(); ++level) {
        const std::size_t which = calls++ % isas.size();
        OutwardSearch& search = searches[which];
        ReachAccess::run(search.reach, query, level);
        f(SearchCase{mesh, oracle, index, query, kernels(isas[which])}, search);
        if (testing::Test::HasFatalFailure()) return calls;
      }
    }
  }
  return calls;
}

/// The same for `vertices_per_mesh` vertices of each of some small meshes of a family, at all radii of `draw_radii`.
template <class F>
std::size_t for_each_outward_search(const Family& family, std::size_t meshes, std::size_t vertices_per_mesh, F&& f) {
  std::size_t calls = 0;
  for (std::uint64_t seed = 0; seed < meshes; ++seed) {
    const TestMesh mesh = make_mesh(family, seed, seed == 0 ? 1500 : std::min<std::size_t>(draw_size(seed), 400));
    Random random(seed);
    const auto draw = [&](const Oracle& oracle) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      std::vector<std::pair<VertexId, double>> queries;
      for (const double radius : draw_radii(random, oracle, v)) queries.emplace_back(v, radius);
      return queries;
    };
    calls += for_each_level(mesh, vertices_per_mesh, draw, f);
    if (testing::Test::HasFatalFailure()) break;
  }
  return calls;
}

}  // namespace test
}  // namespace meshhood
