// SPDX-License-Identifier: MIT
#include "batch.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>

#include "measure/timing.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kBlocks = 15;
constexpr std::size_t kSearched = 20;
constexpr std::size_t kVerticesPerBatch = 8'000'000;

/// Enough rows for a batch of about eight million vertices, and more than are searched one by one.
std::size_t rows_of_a_batch(const Index& index, double radius, std::mt19937_64& random) {
  constexpr std::size_t kProbes = 16;
  Searcher searcher(index);
  std::size_t found = 0;
  for (std::size_t i = 0; i < kProbes; ++i) {
    found += searcher.count(static_cast<VertexId>(random() % index.vertex_count()), radius);
  }
  return std::min(index.vertex_count(),
                  std::clamp<std::size_t>(kVerticesPerBatch * kProbes / found, 4 * kSearched, 2400));
}

template <class Run>
double microseconds_a_row(std::size_t rows, Run&& run) {
  const double begin = measure::processor_time();
  run();
  return 1e6 * (measure::processor_time() - begin) / static_cast<double>(rows);
}

double search(const measure::Method& method, std::span<const VertexId> vertices, double radius) {
  std::vector<VertexId> out;
  return microseconds_a_row(vertices.size(), [&] {
    for (const VertexId v : vertices) method.neighborhood(v, radius, out);
  });
}

}  // namespace

BatchTimes time_batches(Contestants& contestants, const Index& index, double radius_edges, double unit) {
  const double radius = radius_edges * unit;
  const measure::Method bfs = contestants.method("bfs");
  const measure::Method bfs_reordered = contestants.method("bfs-reordered");
  std::mt19937_64 random(11);
  BatchTimes times{radius_edges, rows_of_a_batch(index, radius, random), {}, {}, {}, {}};
  std::vector<VertexId> vertices(times.rows);
  std::uint64_t found = 0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    std::iota(vertices.begin(), vertices.end(),
              static_cast<VertexId>(random() % (index.vertex_count() - times.rows + 1)));
    const auto searched = std::span(vertices).first(std::min(kSearched, times.rows));
    times.bfs.push_back(search(bfs, searched, radius));
    times.bfs_reordered.push_back(search(bfs_reordered, searched, radius));
    const BatchQuery query{.vertices = vertices, .radius = radius};
    times.ids.push_back(microseconds_a_row(times.rows, [&] {
      for_each_neighborhood(index, query, [&](const BatchRow& row) { found += row.ids.size(); });
    }));
    times.count.push_back(microseconds_a_row(times.rows, [&] {
      for (const std::uint64_t count : neighborhood_sizes(index, query)) found -= count;
    }));
  }
  if (found != 0) throw std::logic_error("the counts of a batch differ from its rows");
  return times;
}

}  // namespace meshhood::bench
