// SPDX-License-Identifier: MIT
// The profile of sec. 4.3: the share of each phase in the time of the paper's query. Prints one JSON document.
// Usage: phases MESH QUERIES RADIUS...: radii in mean edge lengths.
//
// The phases are private to the query, so this program includes its source.
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "mesh_argument.h"
#include "paper/query.cpp"  // NOLINT(bugprone-suspicious-include): its phases are timed
#include "program.h"

namespace meshhood::inline v0_1::paper {

/// Climb up, breadth-first search, range search; the last includes the copy of the ids.
using PhaseSeconds = std::array<double, 3>;

struct SearcherAccess {
  static PhaseSeconds time_phases(Searcher& searcher, VertexId v, double radius, std::vector<VertexId>& out) {
    return std::visit([&](const auto& hierarchy) { return run_phases(hierarchy, searcher, v, radius, out); },
                      searcher.storage_->hierarchy);
  }

 private:
  template <class Real>
  static PhaseSeconds run_phases(const Hierarchy<Real>& hierarchy, Searcher& searcher, VertexId v, double radius,
                                 std::vector<VertexId>& out) {
    using Clock = std::chrono::steady_clock;
    std::array<Clock::time_point, 4> at;
    at[0] = Clock::now();
    Searcher::Query<Real> query(searcher, hierarchy, v, radius);
    searcher.scratch_->pieces.clear();
    query.climb_up(radius / QueryOptions{}.radius_ratio);
    at[1] = Clock::now();
    query.breadth_first_search();
    at[2] = Clock::now();
    query.range_search();
    query.collect(out);
    at[3] = Clock::now();
    const auto seconds = [&](std::size_t i) { return std::chrono::duration<double>(at[i + 1] - at[i]).count(); };
    return {seconds(0), seconds(1), seconds(2)};
  }
};

}  // namespace meshhood::inline v0_1::paper

namespace meshhood::bench {
namespace {

/// The phases in per cent of a query; the mean of the shares, so that an interrupted query has no larger weight.
class Shares {
 public:
  void add(const paper::PhaseSeconds& phases) {
    const double whole = phases[0] + phases[1] + phases[2];
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += 100 * phases[i] / whole;
    ++queries_;
  }

  void print(double radius, bool last) const {
    const auto mean = [&](std::size_t i) { return sum_[i] / static_cast<double>(queries_); };
    std::printf(R"({"radius_edges": %g, "climb_up": %.2f, "breadth_first": %.2f, "range_search": %.2f}%s)", radius,
                mean(0), mean(1), mean(2), last ? "" : ", ");
  }

 private:
  std::array<double, 3> sum_{};
  std::size_t queries_ = 0;
};

void profile(const MeshView& mesh, std::size_t queries, const std::vector<double>& radii) {
  const paper::Index index = paper::build(mesh);
  const Adjacency graph = adjacency(mesh);
  const double unit = mean_edge_length({mesh.positions, graph.view()});
  paper::Searcher searcher(index);
  std::mt19937_64 random(1);
  std::vector<VertexId> out;
  std::printf("[");
  for (const double radius : radii) {
    Shares shares;
    for (std::size_t i = 0; i < queries; ++i) {
      const auto v = static_cast<VertexId>(random() % index.vertex_count());
      shares.add(paper::SearcherAccess::time_phases(searcher, v, radius * unit, out));
    }
    shares.print(radius, radius == radii.back());
  }
  std::printf("]\n");
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  using namespace meshhood::bench;
  return run_program(argc, argv, {"phases MESH QUERIES RADIUS...", 3}, [](const Arguments& arguments) {
    profile(MeshArgument(arguments[0]).view(), std::stoul(arguments[1]), numbers(arguments, 2));
    return 0;
  });
}
