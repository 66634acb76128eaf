// SPDX-License-Identifier: MIT
// Exact queries: the search of the paper, and the step that it leaves out. The outward search goes from the query
// vertex over linked, connected nodes of the tree, and finds all that may be connected with it in the ball: whole
// nodes, and leaves at the surface of the ball. That is the answer and perhaps other components of the ball. Each of
// those has a vertex that is nearest to the query vertex, and that is a local minimum of the distance among its
// neighbors, so its leaf is in doubt (see MinimumRegion). What is in doubt is settled by marks on whole nodes
// that are surely connected with the query vertex, and by traversals from the local minima that no marked node touches.
// Where these would visit much of the ball, all that was reached is united along its links instead. docs/design.md says
// why that is exact.
//
// An answer that lies in few leaves takes none of these steps. Where the ball is small, or the answer is a small part
// of what is reached, a breadth-first search over leaves is faster; and where the graph is unlike a surface, one over
// vertices.
#include <algorithm>
#include <cstddef>

#include "meshhood/search.h"

#include "base/distance.h"
#include "exact/index_access.h"
#include "exact/node_search.h"
#include "exact/search/output.h"
#include "exact/search/searcher_state.h"

namespace meshhood {

bool Searcher::State::is_found_over_vertices(VertexId v, double radius) {
  ids = vertex_bfs.find(v, radius);
  if (ids.empty()) search(v, radius);
  return !ids.empty();
}

void Searcher::State::search(VertexId v, double radius) {
  // A call for valid arguments would take a tenth of the shortest queries.
  if (v >= index->vertex_count() || !(radius >= 0)) check_query(v, index->vertex_count(), radius);
  if (radius != bounds.radius) bounds = RadiusBounds(index->frame, radius);
  answer.clear();
  ids = {};
  was_outward = was_united = false;
  const bool is_small = limits.is_small(bounds.radius_in_frame, *index);
  const bool is_by_rows = !is_small && vertex_bfs.is_by_rows();
  if (is_by_rows && is_answer_small()) {  // before the leaf is read, which this search does not need
    ids = vertex_bfs.find_all(v, radius);
    return;
  }
  const std::uint32_t slot = index->slot[v];
  const LeafId home = leaf_of(slot);
  if (!memory.expects_one_vertex()) traversal.prefetch_leaf(index->leaves[home]);
  if (search_few_leaves(slot, index->position(home, lane_of(slot)), memory.enter(home))) return;
  const Query query(*index, v, bounds);
  // A leaf that is not connected has no links, so the answer is a part of it.
  was_outward = !is_small && index->leaves[home].connected && (is_by_rows || !is_answer_small());
  if (was_outward) {
    search_outward(query);
  } else if (is_by_rows) {
    ids = vertex_bfs.find_all(v, radius);
  } else {
    leaf_bfs.run(query, is_small, traversal, answer);
    leaf_visits = leaf_bfs.visits();
  }
}

/// Returns false if the answer has vertices of many leaves, or probably has.
bool Searcher::State::search_few_leaves(std::uint32_t slot, const Point& center, bool is_near) {
  const LeafId home = leaf_of(slot);
  if (!limits.may_lie_in_few_leaves(bounds.radius_in_frame, home, is_near, *index)) return false;
  if (!index->links_of(home).empty() && vertex_bfs.expects_many(home, bounds.radius)) return false;
  bool is_one_vertex = memory.expects_one_vertex() && few_leaves.is_isolated(slot, center, bounds.leaf.squared_radius);
  if (is_one_vertex) {
    answer.add(LeafSubset{leaf_of(slot), LaneMask{1} << lane_of(slot)});
  } else {
    if (!few_leaves.find(slot, LeafBall(center, bounds.leaf), answer)) return false;
    is_one_vertex = answer.is_one_vertex();
  }
  leaf_visits = few_leaves.leaf_count();
  memory.record_few_leaves(is_one_vertex);
  return true;
}

/// Whether the answer probably has few leaves, as in recent balls where other components had many.
bool Searcher::State::is_answer_small() {
  memory.begin_ball(bounds.radius);
  return limits.enabled && memory.is_answer_small();
}

void Searcher::State::search_outward(const Query& query) {
  reach(query);
  find_surface_leaves(query);
  const bool should_unite = limits.enabled && memory.should_unite();
  was_united = should_unite || !remove_other_components(query);
  if (was_united) {
    answer.clear();  // mutant: failed-search-leaves-answer
    reached_components.find(query, descent.groups(), surface_leaves, states, answer);
  }
  leaf_visits = descent.surface_leaves().size();
  if (!should_unite) record_search();
}

/// Adds what was reached to the answer, without the other components. Returns false if uniting all that was reached is
/// probably faster.
bool Searcher::State::remove_other_components(const Query& query) {
  mark_home(query);
  add_reached();
  loose.find(query, descent.groups(), surface_leaves, marks, states);
  const std::size_t most_visited = limits.most_visited(descent.surface_leaves().size());
  if (!other_components.find(query, loose.minima(), marks, states, most_visited, traversal)) return false;
  answer.subtract(other_components.found());
  return true;
}

/// After a search for other components.
void Searcher::State::record_search() {
  const std::size_t surface = descent.surface_leaves().size();
  std::size_t steps = loose.leaf_count() + other_components.visited();
  leaf_visits += steps;
  if (was_united) steps += surface;  // the cost of uniting is added
  memory.record({surface, answer.count() / kLeafCapacity, steps});
}

/// Finds the nodes in the ball that may be connected with the query vertex. Begins with large nodes, which are few.
/// Where they reach more than a single sheet, begins again with small ones, which leave out what is not connected at
/// that scale.
void Searcher::State::reach(const Query& query) {
  // How many mean radii of nodes the radius of the ball has at most.
  constexpr double kSmallNodes = 10;   // the paper's f
  constexpr double kLargeNodes = 2.5;  // chosen: larger ones hide which parts are connected within the ball
  const Home small = home_of(query, kSmallNodes);
  const Home large = home_of(query, kLargeNodes);
  if (large.level > small.level && !memory.should_start_small()) {
    const bool is_single_sheet = reach_from(large, query, small.level);
    memory.record_large_start(is_single_sheet);
    if (is_single_sheet) return;
  }
  static_cast<void>(reach_from(small, query, small.level));
}

/// The node over the query vertex on the lowest level whose nodes have a mean radius of a `ratio`-th of the radius or
/// more.
Searcher::State::Home Searcher::State::home_of(const Query& query, double ratio) const {
  Home home{0, query.leaf()};
  for (; index->tree[home.level].mean_radius * ratio < query.radius_in_frame; ++home.level) {
    const NodeId parent = index->parents[home.node / kFanOut];
    if (parent == kNoNode) break;
    home.node = parent;
  }
  return home;
}

/// Returns false if more nodes intersect the surface of the ball, on a level above `limited_above`, than a single sheet
/// has.
bool Searcher::State::reach_from(const Home& home, const Query& query, std::size_t limited_above) {
  states.start(index->tree[home.level].first_group + index->tree[home.level].groups);
  waves.run(home.node, query.tree_ball, states);
  return descent.run(home.level, waves.groups(), query, limits, limited_above, states);
}

void Searcher::State::find_surface_leaves(const Query& query) {
  constexpr std::size_t kLeavesAhead = 10;
  const std::span<const LeafId> leaves = descent.surface_leaves();
  // From the records of groups, which the descent has just read.
  const auto vertices_of = [&](LeafId leaf) { return run_of(index->records[leaf / kFanOut], leaf % kFanOut); };
  const auto prefetch_vertices = [&](LeafId leaf) {
    prefetch_positions(*index, vertices_of(leaf).begin, kLeafCapacity);
  };
  for (const LeafId leaf : leaves.first(std::min(kLeavesAhead, leaves.size()))) prefetch_vertices(leaf);
  surface_leaves.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kLeavesAhead < leaves.size()) prefetch_vertices(leaves[i + kLeavesAhead]);
    const auto [first, end] = vertices_of(leaves[i]);
    const LaneMask lanes = kernels->within(index->positions, first, end - first, query.ball);
    if (lanes == 0 || lanes == first_lanes(end - first)) {
      settle(leaves[i], lanes != 0);
    } else {
      surface_leaves.push_back({leaves[i], lanes});
    }
  }
}

/// For a leaf that intersects the ball by its sphere, but whose vertices are all in the ball, or all outside.
void Searcher::State::settle(LeafId leaf, bool is_whole) {
  GroupState& state = states[leaf / kFanOut];
  const NodeSet bit = node_at(leaf % kFanOut);
  state.intersecting &= static_cast<NodeSet>(~bit);
  if (is_whole) state.whole |= bit;  // mutant: whole-surface-leaf-dropped
}

/// Marks the whole nodes at the query vertex, from which the marks spread.
void Searcher::State::mark_home(const Query& query) {
  marks.mark(query.leaf(), states);
  const auto own = std::find_if(surface_leaves.begin(), surface_leaves.end(),
                                [&](const LeafSubset& leaf) { return leaf.leaf == query.leaf(); });
  if (own != surface_leaves.end()) {
    const LaneMask piece =
        kernels->reachable(&index->adjacency[index->leaves[own->leaf].first], own->lanes, query.lane());
    for (const Link& link : index->links_of(own->leaf)) {
      const bool is_linked = (link.boundary & piece) != 0;  // mutant: mark-of-another-piece
      if (is_linked) marks.mark(link.leaf, states);
    }
  }
}

/// Adds all vertices reached to the answer.
void Searcher::State::add_reached() {
  for (const std::uint32_t group : descent.groups()) {
    for_each_node(states[group].whole, [&](unsigned i) { answer.add(run_of(index->records[group], i)); });
  }
  for (const LeafSubset& leaf : surface_leaves) answer.add(leaf);
}

void Searcher::State::write_answer(std::vector<VertexId>& out) const {
  constexpr std::size_t kFewIds = 8;  // chosen; for more, kernels are faster
  const std::size_t size = answer.count();
  if (size <= kFewIds) {
    out.resize(size);
    VertexId* id = out.data();
    answer.for_each([&](std::size_t vertex) { *id++ = index->id(vertex); });
  } else {
    out.resize(size + kLeafCapacity);
    write_ids(answer, *index, *kernels, out.data());
    out.resize(size);
  }
}

Searcher::Searcher(const Index& index) : state_(std::make_unique<State>(IndexAccess::share(index), best_isa())) {}
Searcher::Searcher(Searcher&&) noexcept = default;
Searcher& Searcher::operator=(Searcher&&) noexcept = default;
Searcher::~Searcher() = default;

std::size_t Searcher::vertex_count() const { return state_->index->vertex_count(); }

std::span<const VertexId> Searcher::permutation() const {
  const std::span<const VertexId> padded = state_->index->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  if (state_->is_found_over_vertices(v, radius)) {
    out.assign(state_->ids.begin(), state_->ids.end());
    return;
  }
  state_->write_answer(out);
  state_->record(v, radius, out.size());
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  if (state_->is_found_over_vertices(v, radius)) {
    distances.reserve(state_->ids.size());
    out.assign(state_->ids.begin(), state_->ids.end());
    state_->vertex_bfs.measure(v, out, distances);
    return;
  }
  // Before `out` changes: if this throws, neither has changed.
  distances.reserve(state_->answer.count());
  state_->write_answer(out);
  distances.resize(out.size());
  write_distances(state_->answer, *state_->index, state_->center_of(v), distances.data());
  state_->record(v, radius, out.size());
}

std::span<const VertexRange> Searcher::ranges(VertexId v, double radius) {
  if (state_->is_found_over_vertices(v, radius)) return state_->vertex_bfs.ranges_of(state_->ids);
  if (state_->vertex_bfs.learns()) state_->record(v, radius, state_->answer.count());
  return state_->answer.all_as_runs();
}

std::size_t Searcher::count(VertexId v, double radius) {
  if (state_->is_found_over_vertices(v, radius)) return state_->ids.size();
  const std::size_t result = state_->answer.count();
  state_->record(v, radius, result);
  return result;
}

}  // namespace meshhood
