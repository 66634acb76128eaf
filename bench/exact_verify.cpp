// SPDX-License-Identifier: MIT
// Compares exact answers with the reference, for tools/verify: single queries and the batch, id for id.
// Usage: exact_verify MESH STEP RADIUS...: the vertices of every STEP-th leaf, radii in mean edge lengths ("inf"
// allowed). For each vertex also with the distance to a random vertex of the answer as the radius, and the two adjacent
// numbers.
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

class Verify {
 public:
  explicit Verify(const MeshView& mesh)
      : mesh_(mesh), reference_(mesh), index_(build(mesh)), searcher_(index_), stamp_(index_.vertex_count()) {}

  void run(std::size_t step, const std::vector<double>& edges) {
    const double mean_edge = mean_edge_length({mesh_.positions, reference_.adjacency()});
    const std::span<const VertexId> starts = index_.leaf_starts();
    for (std::size_t leaf = 0; leaf + 1 < starts.size(); leaf += step) {
      for (std::size_t i = starts[leaf]; i < starts[leaf + 1]; ++i) vertices_.push_back(index_.permutation()[i]);
    }
    ties_.resize(vertices_.size());
    for (const double radius : edges) query(std::vector<double>(vertices_.size(), radius * mean_edge));
    query_ties();
  }

  [[nodiscard]] std::size_t queries() const { return queries_; }
  [[nodiscard]] std::size_t differences() const { return differences_; }

 private:
  void query(const std::vector<double>& radii) {
    for_each_neighborhood(index_, {.vertices = vertices_, .radius = radii},
                          [&](const BatchRow& row) { compare(vertices_[row.row], radii[row.row], row); },
                          {.in_index_order = true});
  }

  void compare(VertexId v, double radius, const BatchRow& row) {
    reference_.neighborhood(v, radius, expected_);
    searcher_.neighborhood(v, radius, found_);
    ++queries_;
    ties_[row.row] = distance(mesh_.positions, v, expected_[random_() % expected_.size()]);
    if (is_expected(row.ids) && is_expected(found_) && searcher_.count(v, radius) == expected_.size()) return;
    if (++differences_ <= 5) {
      std::fprintf(stderr, "vertex %u, radius %.17g: %zu vertices, in a batch %zu, expected %zu\n",
                   static_cast<unsigned>(v), radius, found_.size(), row.ids.size(), expected_.size());
    }
  }

  /// At the distance of a vertex of the last answer, which is then on the boundary of the ball.
  void query_ties() {
    const std::vector<double> ties = ties_;
    const auto next_to = [&](double direction) {
      std::vector<double> radii = ties;
      for (double& radius : radii) radius = std::nextafter(radius, direction);
      return radii;
    };
    query(ties);
    query(next_to(0));
    query(next_to(std::numeric_limits<double>::max()));
  }

  bool is_expected(std::span<const VertexId> found) {
    ++round_;
    for (const VertexId w : expected_) stamp_[w] = round_;
    for (const VertexId w : found) {
      if (stamp_[w] != round_) return false;
      stamp_[w] = 0;  // so that a repeated vertex is detected
    }
    return found.size() == expected_.size();
  }

  MeshView mesh_;
  ReferenceSearcher reference_;
  Index index_;
  Searcher searcher_;
  std::vector<VertexId> vertices_;  // of all rows
  std::vector<double> ties_;        // the distance of a vertex of the last answer to each
  std::vector<std::uint64_t> stamp_;
  std::uint64_t round_ = 0;
  std::vector<VertexId> expected_;
  std::vector<VertexId> found_;
  std::mt19937_64 random_{1};
  std::size_t queries_ = 0;
  std::size_t differences_ = 0;
};

int run(const Arguments& arguments) {
  const std::string& name = arguments[0];
  const MeshArgument mesh(name);
  if (mesh.view().positions.size() == 0) return 0;
  Verify verify(mesh.view());
  verify.run(std::stoul(arguments[1]), numbers(arguments, 2));
  std::printf("%s: %zu queries, %zu differences\n", name.substr(name.find_last_of('/') + 1).c_str(), verify.queries(),
              verify.differences());
  return verify.differences() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"exact_verify MESH STEP RADIUS...", 3}, meshhood::bench::run);
}
