// SPDX-License-Identifier: MIT
// The mean of a signal over the neighborhood of each vertex, without lists of ids: the neighborhoods of up to 32
// vertices are visited together, and each value is read once for all of them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <span>
#include <vector>

#include <meshhood/meshhood.h>

namespace {

constexpr std::uint32_t kSide = 100;

meshhood::Index index_of_grid() {
  std::vector<float> xyz;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t v = 0; v < kSide * kSide; ++v) {
    const std::uint32_t column = v % kSide;
    const std::uint32_t row = v / kSide;
    xyz.insert(xyz.end(), {static_cast<float>(column), static_cast<float>(row), 0.0F});
    if (column + 1 == kSide || row + 1 == kSide) continue;
    corners.insert(corners.end(), {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide});
  }
  return meshhood::build({xyz, meshhood::FacesView::triangles(corners)});
}

/// Means of a signal over the neighborhoods of a packet. Each thread has one, for its scratch memory.
class MeanOfPackets {
 public:
  /// `signal` is in index order; the results are by row.
  MeanOfPackets(std::span<const double> signal, std::span<double> means) : signal_(signal), means_(means) {}

  void operator()(const meshhood::PacketAnswer& answer) {
    sums_.assign(answer.rows.size(), 0);
    counts_.assign(answer.rows.size(), 0);
    if (answer.begins_group) core_sums_.clear();
    for (const meshhood::CoreLeaves& core : answer.cores) {
      add(core.queries, sum_of_core(core), static_cast<double>(core.vertices));
    }
    for (const meshhood::WholeLeaves& whole : answer.whole) {
      add(whole.queries, sum_of_run(whole.run), static_cast<double>(whole.run.vertices.size()));
    }
    for (const meshhood::PartialLeaf& leaf : answer.partial) {
      for (std::size_t i = 0; i < leaf.vertices.size(); ++i) add(leaf.queries[i], signal_[leaf.vertices.begin + i], 1);
    }
    for (std::size_t i = 0; i < answer.rows.size(); ++i) means_[answer.rows[i]] = sums_[i] / counts_[i];
  }

 private:
  void add(meshhood::QueryWord queries, double sum, double count) {
    meshhood::for_each_query(queries, [&](std::size_t i) {
      sums_[i] += sum;
      counts_[i] += count;
    });
  }

  [[nodiscard]] double sum_of_run(const meshhood::LeafRun& run) const {
    return std::accumulate(signal_.begin() + run.vertices.begin, signal_.begin() + run.vertices.end, 0.0);
  }

  /// A core is the same in all packets of a group, so that it is summed once.
  double sum_of_core(const meshhood::CoreLeaves& core) {
    if (core.number >= core_sums_.size()) core_sums_.resize(core.number + 1, std::nan(""));
    double& sum = core_sums_[core.number];
    if (std::isnan(sum)) {
      sum = 0;
      for (const meshhood::LeafRun& run : core.runs) sum += sum_of_run(run);
    }
    return sum;
  }

  std::span<const double> signal_;
  std::span<double> means_;
  std::vector<double> sums_;
  std::vector<double> counts_;
  std::vector<double> core_sums_;  // by number; NaN where not known yet
};

}  // namespace

int main() {
  const meshhood::Index index = index_of_grid();
  std::vector<double> signal;  // in index order; here the column of each vertex
  for (const meshhood::VertexId v : index.permutation()) signal.push_back(v % kSide);

  std::vector<double> means(index.vertex_count());
  meshhood::for_each_packet(index, {.radius = 10}, [&](unsigned /*thread*/) { return MeanOfPackets(signal, means); },
                            {.threads = 0});

  const meshhood::VertexId center = kSide * kSide / 2 + kSide / 2;
  std::printf("means around vertices 0 and %u: %g and %g\n", static_cast<unsigned>(center), means[0], means[center]);

  // For a single vertex: the neighborhood as runs. A visit may end early: is the signal above 55 anywhere?
  meshhood::Searcher searcher(index);
  const auto is_low = [&](meshhood::VertexRange run) {
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (signal[i] > 55) return false;
    }
    return true;
  };
  const bool all_low = meshhood::visit(searcher, center, 10.0, is_low);
  std::printf("around vertex %u, %s above 55\n", static_cast<unsigned>(center), all_low ? "none is" : "some are");
  return means[center] == center % kSide && !all_low ? 0 : 1;
}
