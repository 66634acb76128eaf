// SPDX-License-Identifier: MIT
#include "radius_table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "measure/difference.h"
#include "measure/timing.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kBlocks = 50;
constexpr std::size_t kVerticesPerBlock = 2'000'000;

using Vertices = std::vector<VertexId>;

/// Draws the query vertices. The same seed gives the same vertices on every platform, which the distributions of the
/// standard library do not guarantee.
class QueryVertices {
 public:
  QueryVertices(std::span<const VertexId> permutation, const Plan& plan)
      : permutation_(permutation), order_(plan.order), random_(plan.seed) {}

  Vertices next(std::size_t count) {
    Vertices block(count);
    std::size_t i = random_index();
    for (VertexId& v : block) {
      v = permutation_[i];
      i = order_ == Order::Cold ? random_index() : (i + 1) % permutation_.size();
    }
    return block;
  }

 private:
  std::size_t random_index() { return random_() % permutation_.size(); }

  std::span<const VertexId> permutation_;
  Order order_;
  std::mt19937_64 random_;
};

double quantile(std::vector<double> values, double fraction) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + std::lround(fraction * last);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The sums of one contestant at one radius so far.
struct Tally {
  std::vector<double> microseconds;  // per query, by block
  double count = 0;
  double extra = 0;
  double missing = 0;
};

/// All contestants at one radius.
class RadiusRun {
 public:
  RadiusRun(std::span<const Contestant> contestants, double radius, std::size_t vertices)
      : contestants_(contestants),
        radius_(radius),
        vertices_(vertices),
        comparison_(vertices),
        tallies_(contestants.size()) {}

  void run_block(std::span<const VertexId> block) {
    // Rotate the order: the first of a block finds the caches as another left them.
    ++first_;
    for (std::size_t i = 0; i < contestants_.size(); ++i) time((first_ + i) % contestants_.size(), block);
    for (const VertexId v : block) compare(v);
  }

  [[nodiscard]] Measurement result(std::size_t i, double radius_edges, std::size_t queries) const {
    const Tally& tally = tallies_[i];
    const auto mean = [&](double sum) { return sum / static_cast<double>(queries); };
    return {.radius_edges = radius_edges,
            .method = contestants_[i].name,
            .microseconds = quantile(tally.microseconds, 0.5),
            .lower = quantile(tally.microseconds, 0.25),
            .upper = quantile(tally.microseconds, 0.75),
            .count = mean(tally.count),
            .extra = mean(tally.extra),
            .missing = mean(tally.missing)};
  }

 private:
  void time(std::size_t i, std::span<const VertexId> block) {
    const Contestant& contestant = contestants_[i];
    if (contestant.visits_all_vertices) {
      block = block.first(std::clamp<std::size_t>(kVerticesPerBlock / vertices_, 1, block.size()));
    }
    const double start = measure::processor_time();
    for (const VertexId v : block) contestant.neighborhood(v, radius_, answer_);
    tallies_[i].microseconds.push_back(1e6 * (measure::processor_time() - start) / static_cast<double>(block.size()));
  }

  void compare(VertexId v) {
    for (std::size_t i = 0; i < contestants_.size(); ++i) {
      if (!contestants_[i].lists_vertices) continue;
      Vertices& answer = i == 0 ? exact_ : answer_;
      contestants_[i].neighborhood(v, radius_, answer);
      const measure::Difference difference = comparison_.compare(exact_, answer);
      tallies_[i].count += static_cast<double>(answer.size());
      tallies_[i].extra += static_cast<double>(difference.extra);
      tallies_[i].missing += static_cast<double>(difference.missing);
    }
  }

  std::span<const Contestant> contestants_;
  double radius_;
  std::size_t vertices_;
  measure::Comparison comparison_;
  std::vector<Tally> tallies_;
  std::size_t first_ = 0;
  Vertices exact_;
  Vertices answer_;
};

/// The size of block `i` of `blocks` if `total` is divided as evenly as possible.
std::size_t share(std::size_t total, std::size_t i, std::size_t blocks) {
  return total * (i + 1) / blocks - total * i / blocks;
}

}  // namespace

Contestant contestant(std::string name, const SearchMethod& method) {
  const auto searcher = std::make_shared<AnySearcher>(method.make_searcher());
  return {.name = std::move(name), .neighborhood = [searcher](VertexId v, double radius, std::vector<VertexId>& out) {
            std::visit([&](auto& one) { one.neighborhood(v, radius, out); }, *searcher);
          }};
}

std::vector<Measurement> measure_radii(std::span<const Contestant> contestants, const Plan& plan, double unit,
                                       std::span<const VertexId> permutation,
                                       const std::function<void(std::size_t done, std::size_t total)>& report) {
  std::vector<Measurement> table;
  QueryVertices vertices(permutation, plan);
  const std::size_t blocks = std::min(kBlocks, plan.queries);
  const std::size_t steps = plan.radii.size() * blocks;
  std::size_t step = 0;
  for (const double radius : plan.radii) {
    RadiusRun run(contestants, unit * radius, permutation.size());
    for (std::size_t i = 0; i < blocks; ++i) {
      run.run_block(vertices.next(share(plan.queries, i, blocks)));
      report(++step, steps);
    }
    for (std::size_t i = 0; i < contestants.size(); ++i) table.push_back(run.result(i, radius, plan.queries));
  }
  return table;
}

}  // namespace meshhood::bench
