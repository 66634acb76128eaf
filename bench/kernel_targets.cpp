// SPDX-License-Identifier: MIT
// The targets of the kernels against each other: the same work with each that this processor has, on one thread, in
// alternating rounds. Microseconds a row with the slowest target, which has no vector instructions on x86, and how many
// times as fast the others are; the fastest round of each.
//
//   kernel_targets MESH [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"
#include "simd/kernels.h"

namespace meshhood::bench {
namespace {

constexpr int kRounds = 9;
constexpr std::size_t kSingle = 2000;  // queries one after another
constexpr std::size_t kRows = 10000;   // of a batch: consecutive in index order

struct Work {
  const char* name;
  std::size_t rows;
  std::function<void()> run;
};

class KernelTargets {
 public:
  explicit KernelTargets(const MeshView& mesh) : mesh_(reorder(mesh)), surface_(mesh_.index, mesh_.view()) {
    mean_edge_ = mean_edge_length(mesh_.index);
    const std::size_t vertices = mesh_.index.vertex_count();
    const std::size_t rows = std::min(kRows, vertices);
    for (std::size_t i = 0; i < kSingle; ++i) spread_.push_back(static_cast<VertexId>(i * vertices / kSingle));
    for (std::size_t i = 0; i < rows; ++i) rows_.push_back(static_cast<VertexId>((vertices - rows) / 2 + i));
    for (std::size_t i = 0; i < vertices; ++i) values_.push_back(std::sin(static_cast<double>(i)));
  }

  void run(double edges) {
    for (const Work& work : all_work(edges * mean_edge_)) {
      std::vector<double> least(targets_, std::numeric_limits<double>::infinity());
      for (int round = 0; round < kRounds; ++round) {
        for (std::size_t target = 0; target < targets_; ++target) {
          limit_isa(static_cast<Isa>(target));
          const double start = measure::processor_time();
          work.run();
          least[target] = std::min(least[target], measure::processor_time() - start);
        }
      }
      std::printf("%6.4g %-14s %9.4f", edges, work.name, 1e6 * least[0] / static_cast<double>(work.rows));
      for (const double seconds : least) std::printf(" %7.2f", least[0] / seconds);
      std::printf("\n");
      std::fflush(stdout);
    }
  }

  void print_header() const {
    std::printf("%6s %-14s %9s", "edges", "", "us a row");
    for (std::size_t target = 0; target < targets_; ++target) std::printf(" %7s", name_of(static_cast<Isa>(target)));
    std::printf("\n");
  }

 private:
  [[nodiscard]] std::vector<Work> all_work(double radius) {
    const BatchQuery batch{.vertices = rows_, .radius = radius};
    const auto aggregated = [this, radius](Reduce reduce, SmoothingKernel kernel) {
      static_cast<void>(aggregate(mesh_.index, {.values = values_},
                                  {.vertices = rows_, .radius = radius, .reduce = {reduce}, .kernel = kernel},
                                  {.threads = 1}));
    };
    return {
        {"one, count", kSingle,
         [this, radius] {
           Searcher searcher(mesh_.index);
           for (const VertexId v : spread_) static_cast<void>(searcher.count(v, radius));
         }},
        {"one, ids", kSingle,
         [this, radius] {
           Searcher searcher(mesh_.index);
           for (const VertexId v : spread_) searcher.neighborhood(v, radius, ids_);
         }},
        {"batch, count", rows_.size(),
         [this, batch] { static_cast<void>(counts(mesh_.index, batch, {.threads = 1})); }},
        {"batch, ids", rows_.size(),
         [this, batch] { static_cast<void>(neighborhoods(mesh_.index, batch, {}, {.threads = 1})); }},
        {"mean", rows_.size(), [=] { aggregated(Reduce::Mean, SmoothingKernel::Box); }},
        {"biweight", rows_.size(), [=] { aggregated(Reduce::Mean, SmoothingKernel::Biweight); }},
        {"gaussian", rows_.size(), [=] { aggregated(Reduce::Mean, SmoothingKernel::Gaussian); }},
        {"minimum", rows_.size(), [=] { aggregated(Reduce::Minimum, SmoothingKernel::Box); }},
        {"variance", rows_.size(), [=] { aggregated(Reduce::Variance, SmoothingKernel::Box); }},
        {"curvature", rows_.size(),
         [this, batch] { static_cast<void>(curvatures(surface_, batch, {}, {.threads = 1})); }},
        {"invariants", rows_.size(), [this, batch] { static_cast<void>(invariants(surface_, batch, {.threads = 1})); }},
    };
  }

  ReorderedMesh mesh_;
  Surface surface_;
  double mean_edge_ = 0;
  std::size_t targets_ = static_cast<std::size_t>(best_isa()) + 1;
  std::vector<VertexId> spread_;
  std::vector<VertexId> rows_;
  std::vector<double> values_;
  std::vector<VertexId> ids_;
};

int run(const Arguments& arguments) {
  KernelTargets targets(MeshArgument(arguments.front()).view());
  targets.print_header();
  for (const double edges : numbers(arguments, 1, {2, 5, 10, 20})) targets.run(edges);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"kernel_targets MESH [RADIUS IN MEAN EDGES...]", 1},
                                      meshhood::bench::run);
}
