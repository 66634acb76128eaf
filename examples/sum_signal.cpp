// SPDX-License-Identifier: MIT
// Sums a signal over neighborhoods without copying ids: the signal is put into index order once, and each neighborhood
// is visited as runs of that order.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
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

}  // namespace

int main() {
  const meshhood::Index index = index_of_grid();
  meshhood::Searcher searcher(index);
  std::vector<double> signal;  // in index order; here the column of each vertex
  for (const meshhood::VertexId v : index.permutation()) signal.push_back(v % kSide);

  const meshhood::VertexId centre = kSide * kSide / 2 + kSide / 2;
  const auto add = [&](double sum, meshhood::VertexRange run) {
    return std::accumulate(signal.begin() + run.begin, signal.begin() + run.end, sum);
  };
  const double sum = meshhood::reduce(searcher, centre, 10.0, 0.0, add);
  const auto count = static_cast<double>(searcher.count(centre, 10.0));

  // A visit may end early: is the signal above 55 anywhere in the neighborhood?
  const auto is_low = [&](meshhood::VertexRange run) {
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (signal[i] > 55) return false;
    }
    return true;
  };
  const bool all_low = meshhood::visit(searcher, centre, 10.0, is_low);

  std::printf("mean of %g vertices: %g; %s above 55\n", count, sum / count, all_low ? "none is" : "some are");
  return sum == count * (centre % kSide) && !all_low ? 0 : 1;
}
