// SPDX-License-Identifier: MIT
// Many neighborhoods in one call: counted, kept in CSR form, and streamed, on all cores.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

#include <meshhood/meshhood.h>

namespace {

constexpr std::uint32_t kSide = 200;

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
  const meshhood::BatchQuery query{.radius = 5.0};  // around every vertex
  const meshhood::Run run{.threads = 2};            // without, one for each processor

  const std::vector<std::uint64_t> counts = meshhood::counts(index, query, run);
  const std::size_t counted = std::accumulate(counts.begin(), counts.end(), std::size_t{0});

  const meshhood::Neighborhoods all = meshhood::neighborhoods(index, query, {}, run);

  std::size_t streamed = 0;
  meshhood::for_each_neighborhood(
      index, query, [&](const meshhood::BatchRow& row) { streamed += row.ids.size(); }, {}, run);

  std::printf("neighbors of %zu vertices: %zu counted, %zu kept, %zu streamed\n", index.vertex_count(), counted,
              all.ids.size(), streamed);
  return counted == all.ids.size() && counted == streamed ? 0 : 1;
}
