// SPDX-License-Identifier: MIT
// One index, many threads: the index never changes, and each thread asks through a searcher of its own.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <thread>
#include <vector>

#include <meshhood/meshhood.h>

namespace {

constexpr std::uint32_t kSide = 200;

meshhood::paper::Index index_of_grid() {
  std::vector<float> xyz;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t v = 0; v < kSide * kSide; ++v) {
    const std::uint32_t column = v % kSide;
    const std::uint32_t row = v / kSide;
    xyz.insert(xyz.end(), {static_cast<float>(column), static_cast<float>(row), 0.0F});
    if (column + 1 == kSide || row + 1 == kSide) continue;
    corners.insert(corners.end(), {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide});
  }
  return meshhood::paper::build({xyz, meshhood::FacesView::triangles(corners)});
}

/// How many vertices all neighborhoods hold together.
std::size_t count_neighbors(const meshhood::paper::Index& index, std::size_t thread_count) {
  std::vector<std::size_t> sums(thread_count);
  const auto ask = [&](std::size_t thread) {
    meshhood::paper::Searcher searcher(index);
    for (std::size_t v = thread; v < index.vertex_count(); v += thread_count) {
      sums[thread] += searcher.count(static_cast<meshhood::VertexId>(v), 5.0);
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(thread_count);
  for (std::size_t thread = 0; thread < thread_count; ++thread) threads.emplace_back(ask, thread);
  for (auto& thread : threads) thread.join();
  return std::accumulate(sums.begin(), sums.end(), std::size_t{0});
}

}  // namespace

int main() {
  const auto index = index_of_grid();
  const std::size_t by_one = count_neighbors(index, 1);
  const std::size_t by_four = count_neighbors(index, 4);
  std::printf("neighbors of %zu vertices: one thread counts %zu, four count %zu\n", index.vertex_count(), by_one,
              by_four);
  return by_one == by_four ? 0 : 1;
}
