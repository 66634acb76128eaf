// SPDX-License-Identifier: MIT
// How long each step of the exact search takes, beside the whole query of the paper. Prints a row of a Markdown table
// for each radius: means over random vertices, in µs of wall-clock time. Each query is asked of both indexes in turn,
// so both find little of its surroundings in the caches. Usage: search_steps MESH QUERIES RADIUS...: radii in mean edge
// lengths.
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "exact/search/searcher_state.h"
#include "mesh_argument.h"
#include "program.h"

namespace meshhood {

/// Runs the steps of `Searcher::State::search` one by one.
class SearchSteps {
 public:
  enum Step { kLeaves, kReach, kSurface, kLoose, kTraversals, kUnite, kOutput, kSteps };

  /// Sums over all queries.
  struct Sums {
    std::array<double, kSteps> microseconds{};
    double leaf_searches = 0;  // queries that were answered without the outward search
    double united = 0;         // queries that united what they reached
    double groups = 0;
    double surface_leaves = 0;
    double settled = 0;
    double cut = 0;
    double minima = 0;
    double visits = 0;
    double foreign = 0;
  };

  explicit SearchSteps(const Index& index) : searcher_(index), state_(SearcherAccess::state(searcher_)) {}

  void query(VertexId v, double radius, std::vector<VertexId>& out) {
    last_ = Clock::now();
    if (radius != state_.bounds.radius) state_.bounds = RadiusBounds(state_.index->frame, radius);
    state_.answer.clear();
    const Query query(*state_.index, v, state_.bounds);
    if (!search_leaves(query)) search_outward(query);
    state_.write_answer(out);
    end(kOutput);
  }

  [[nodiscard]] const Sums& sums() const { return sums_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool search_leaves(const Query& query) {
    const bool is_small = state_.limits.is_small(query.radius_in_frame, *state_.index);
    const bool is_found = state_.search_few_leaves(query.slot, query.center());
    const bool is_outward =
        !is_found && !is_small && state_.index->leaves[query.leaf()].connected && !state_.is_answer_small(query);
    if (is_outward) return false;
    if (!is_found) state_.leaf_bfs.run(query, is_small, state_.traversal, state_.answer);
    ++sums_.leaf_searches;
    end(kLeaves);
    return true;
  }

  void search_outward(const Query& query) {
    state_.reach(query);
    end(kReach);
    state_.find_surface_leaves(query);
    end(kSurface);
    const bool should_unite = state_.memory.should_unite();
    state_.was_united = should_unite || !remove_other_components(query);
    if (state_.was_united) {
      state_.answer.clear();
      state_.reached_components.find(query, state_.descent.groups(), state_.surface_leaves, state_.states,
                                     state_.answer);
      end(kUnite);
    }
    if (!should_unite) state_.record_search();
    count();
  }

  bool remove_other_components(const Query& query) {
    state_.mark_home(query);
    state_.add_reached();
    state_.loose.find(query, state_.descent.groups(), state_.surface_leaves, state_.marks, state_.states);
    end(kLoose);
    const std::size_t most = state_.limits.most_visited(state_.descent.surface_leaves().size());
    const bool is_found =
        state_.other_components.find(query, state_.loose.minima(), state_.marks, state_.states, most, state_.traversal);
    if (is_found) state_.answer.subtract(state_.other_components.found());
    end(kTraversals);
    sums_.cut += static_cast<double>(state_.loose.leaf_count());
    sums_.minima += static_cast<double>(state_.loose.minima().size());
    sums_.visits += static_cast<double>(state_.other_components.visited());
    sums_.foreign += static_cast<double>(state_.other_components.found().size());
    return is_found;
  }

  void count() {
    sums_.united += state_.was_united ? 1 : 0;
    sums_.groups += static_cast<double>(state_.descent.groups().size());
    const auto surface = static_cast<double>(state_.descent.surface_leaves().size());
    sums_.surface_leaves += surface;
    sums_.settled += surface - static_cast<double>(state_.surface_leaves.size());
  }

  void end(Step step) {
    const auto now = Clock::now();
    sums_.microseconds[step] += std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
  }

  Searcher searcher_;
  Searcher::State& state_;
  Sums sums_;
  Clock::time_point last_;
};

namespace bench {
namespace {

double microseconds_of(paper::Searcher& searcher, VertexId v, double radius, std::vector<VertexId>& out) {
  const auto start = std::chrono::steady_clock::now();
  searcher.neighborhood(v, radius, out);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

void print_row(const std::string& mesh, double radius, const SearchSteps::Sums& sums, double paper, double queries) {
  std::printf("| %s, %g |", mesh.c_str(), radius);
  double whole = 0;
  for (const double step : sums.microseconds) whole += step;
  std::printf(" %.2f | %.3g | %.3g |", paper / whole, paper / queries, whole / queries);
  for (const double step : sums.microseconds) std::printf(" %.2g |", step / queries);
  std::printf(" %.0f %% | %.0f %% |", 100 * sums.leaf_searches / queries, 100 * sums.united / queries);
  for (const double sum :
       {sums.groups, sums.surface_leaves, sums.settled, sums.cut, sums.minima, sums.visits, sums.foreign}) {
    std::printf(" %.3g |", sum / queries);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void profile(const std::string& name, std::size_t queries, const std::vector<double>& radii) {
  const MeshArgument mesh(name);
  const Index index = build(mesh.view());
  const paper::Index paper_index = paper::build(mesh.view());
  const Adjacency graph = adjacency(mesh.view());
  const double unit = mean_edge_length({mesh.view().positions, graph.view()});
  paper::Searcher paper(paper_index);
  std::vector<VertexId> out;
  for (const double radius : radii) {
    SearchSteps steps(index);
    std::mt19937_64 random(1);
    double paper_time = 0;
    for (std::size_t i = 0; i < queries; ++i) {
      const auto v = static_cast<VertexId>(random() % index.vertex_count());
      steps.query(v, radius * unit, out);
      paper_time += microseconds_of(paper, v, radius * unit, out);
    }
    print_row(name.substr(name.rfind('/') + 1), radius, steps.sums(), paper_time, static_cast<double>(queries));
  }
}

}  // namespace
}  // namespace bench
}  // namespace meshhood

int main(int arguments, char** values) {
  if (arguments < 4) {
    std::fprintf(stderr, "usage: search_steps MESH QUERIES RADIUS...\n");
    return 2;
  }
  return meshhood::bench::exit_status("search_steps", [&] {
    std::vector<double> radii;
    for (int i = 3; i < arguments; ++i) radii.push_back(std::stod(values[i]));
    meshhood::bench::profile(values[1], std::stoul(values[2]), radii);
    return 0;
  });
}
