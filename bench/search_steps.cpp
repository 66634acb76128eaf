// SPDX-License-Identifier: MIT
// How long each step of the exact search takes, beside the whole query of the paper. Prints a row of a Markdown table
// for each radius: means over random vertices, in µs of wall-clock time. Each query is asked of both indexes in turn,
// so both find little of its surroundings in the caches. Usage: search_steps [--warm] MESH QUERIES RADIUS...: radii in
// mean edge lengths. With --warm, the vertices of a block of queries follow each other in index order.
#include <array>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <random>
#include <string>
#include <utility>
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

  using Microseconds = std::array<double, kSteps>;

  /// Sums over all queries.
  struct Counts {
    double leaf_searches = 0;  // queries that were answered without the outward search
    double united = 0;         // queries that united what they reached
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

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// The caller's id of a vertex in index order.
  [[nodiscard]] VertexId id(std::size_t vertex) const { return state_.index->id(vertex); }

  /// The times since the last call.
  [[nodiscard]] Microseconds take_times() { return std::exchange(times_, {}); }

 private:
  using Clock = std::chrono::steady_clock;

  bool search_leaves(const Query& query) {
    const bool is_small = state_.limits.is_small(query.radius_in_frame, *state_.index);
    const bool is_found = state_.search_few_leaves(query.slot, query.center(), state_.memory.enter(query.leaf()));
    const bool is_outward =
        !is_found && !is_small && state_.index->leaves[query.leaf()].connected && !state_.is_answer_small();
    if (is_outward) return false;
    if (!is_found) state_.leaf_bfs.run(query, is_small, state_.traversal, state_.answer);
    ++counts_.leaf_searches;
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
    counts_.cut += static_cast<double>(state_.loose.leaf_count());
    counts_.minima += static_cast<double>(state_.loose.minima().size());
    counts_.visits += static_cast<double>(state_.other_components.visited());
    counts_.foreign += static_cast<double>(state_.other_components.found().size());
    return is_found;
  }

  void count() {
    counts_.united += state_.was_united ? 1 : 0;
    const auto surface = static_cast<double>(state_.descent.surface_leaves().size());
    counts_.surface_leaves += surface;
    counts_.settled += surface - static_cast<double>(state_.surface_leaves.size());
  }

  void end(Step step) {
    const auto now = Clock::now();
    times_[step] += std::chrono::duration<double, std::micro>(now - last_).count();
    last_ = now;
  }

  Searcher searcher_;
  SearcherAccess::State& state_;
  Microseconds times_{};
  Counts counts_;
  Clock::time_point last_;
};

namespace bench {
namespace {

double microseconds_of(paper::Searcher& searcher, VertexId v, double radius, std::vector<VertexId>& out) {
  const auto start = std::chrono::steady_clock::now();
  searcher.neighborhood(v, radius, out);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

constexpr std::size_t kBlocks = 20;

/// The times of the blocks of queries at one radius.
struct Blocks {
  std::array<std::vector<double>, SearchSteps::kSteps> steps;
  std::vector<double> whole;
  std::vector<double> paper;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How the query vertices of a block follow each other.
enum class Order {
  Cold,  // each at a random place
  Warm,  // each next to the one before, in index order
};

Blocks time_blocks(SearchSteps& steps, paper::Searcher& paper, std::size_t vertices, double radius, std::size_t queries,
                   Order order) {
  Blocks blocks;
  std::mt19937_64 random(1);
  std::vector<VertexId> out;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    double paper_time = 0;
    const std::size_t first = random() % vertices;
    for (std::size_t i = 0; i < queries / kBlocks; ++i) {
      const VertexId v = steps.id((order == Order::Warm ? first + i : random()) % vertices);
      steps.query(v, radius, out);
      paper_time += microseconds_of(paper, v, radius, out);
    }
    const SearchSteps::Microseconds times = steps.take_times();
    for (std::size_t step = 0; step < times.size(); ++step) blocks.steps[step].push_back(times[step]);
    blocks.whole.push_back(std::accumulate(times.begin(), times.end(), 0.0));
    blocks.paper.push_back(paper_time);
  }
  return blocks;
}

void print_header() {
  std::printf(
      "| mesh, r | paper | exact | over leaves | reach | surface leaves | marks and loose pieces | traversals |"
      " uniting | output | queries over leaves | united | leaves at the surface | settled | cut | minima |"
      " visits | foreign |\n|--|");
  for (int i = 0; i < 17; ++i) std::printf("--:|");
  std::printf("\n");
}

void print_row(const std::string& mesh, double radius, const Blocks& blocks, const SearchSteps::Counts& counts,
               std::size_t queries) {
  const auto a_block = static_cast<double>(queries / kBlocks);
  const auto all = a_block * static_cast<double>(kBlocks);
  std::printf("| %s, %g | %.3g | %.3g |", mesh.c_str(), radius, median(blocks.paper) / a_block,
              median(blocks.whole) / a_block);
  for (const std::vector<double>& step : blocks.steps) std::printf(" %.2g |", median(step) / a_block);
  std::printf(" %.0f %% | %.0f %% |", 100 * counts.leaf_searches / all, 100 * counts.united / all);
  for (const double count :
       {counts.surface_leaves, counts.settled, counts.cut, counts.minima, counts.visits, counts.foreign}) {
    std::printf(" %.2g |", count / all);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void profile(const std::string& name, std::size_t queries, const std::vector<double>& radii, Order order) {
  const MeshArgument mesh(name);
  const Index index = build(mesh.view());
  const paper::Index paper_index = paper::build(mesh.view());
  const Adjacency graph = adjacency(mesh.view());
  const double unit = mean_edge_length({mesh.view().positions, graph.view()});
  paper::Searcher paper(paper_index);
  print_header();
  for (const double radius : radii) {
    SearchSteps steps(index);
    const Blocks blocks = time_blocks(steps, paper, index.vertex_count(), radius * unit, queries, order);
    print_row(name.substr(name.rfind('/') + 1), radius, blocks, steps.counts(), queries);
  }
}

}  // namespace
}  // namespace bench
}  // namespace meshhood

int main(int arguments, char** values) {
  using meshhood::bench::Order;
  const bool is_warm = arguments > 1 && std::string(values[1]) == "--warm";
  const int first = is_warm ? 2 : 1;
  if (arguments < first + 3) {
    std::fprintf(stderr, "usage: search_steps [--warm] MESH QUERIES RADIUS...\n");
    return 2;
  }
  return meshhood::bench::exit_status("search_steps", [&] {
    std::vector<double> radii;
    for (int i = first + 2; i < arguments; ++i) radii.push_back(std::stod(values[i]));
    meshhood::bench::profile(values[first], std::stoul(values[first + 1]), radii, is_warm ? Order::Warm : Order::Cold);
    return 0;
  });
}
