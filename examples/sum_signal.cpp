// SPDX-License-Identifier: MIT
// The mean of a signal over the neighborhood of each vertex, without lists of ids; and a question about one
// neighborhood that needs no list either.
#include <cstddef>
#include <cstdint>
#include <cstdio>
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
  return meshhood::build(xyz, corners);
}

}  // namespace

int main() {
  const meshhood::Index index = index_of_grid();
  std::vector<double> signal;  // here the column of each vertex
  for (std::size_t v = 0; v < index.vertex_count(); ++v) signal.push_back(static_cast<double>(v % kSide));
  const std::vector<double> means =
      meshhood::aggregate(index, {.values = signal}, {.radius = 10.0, .reduce = {meshhood::Reduce::Mean}});

  const meshhood::VertexId center = kSide * kSide / 2 + kSide / 2;
  std::printf("means around vertices 0 and %u: %g and %g\n", static_cast<unsigned>(center), means[0], means[center]);

  // For a single vertex: the neighborhood as runs of the index order. A visit may end early: is the signal above 55
  // anywhere?
  std::vector<double> in_index_order;
  for (const meshhood::VertexId v : index.permutation()) in_index_order.push_back(signal[v]);
  meshhood::Searcher searcher(index);
  const auto is_low = [&](meshhood::VertexRange run) {
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (in_index_order[i] > 55) return false;
    }
    return true;
  };
  const bool all_low = meshhood::visit(searcher, center, 10.0, is_low);
  std::printf("around vertex %u, %s above 55\n", static_cast<unsigned>(center), all_low ? "none is" : "some are");
  return means[center] == center % kSide && !all_low ? 0 : 1;
}
