// SPDX-License-Identifier: MIT
// A mesh that is already in memory: only the data that the index keeps is copied. The mesh is a paper strip, folded so
// that its ends lie on each other. The ball contains vertices of both ends, the neighborhood those of one.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <meshhood/meshhood.h>

namespace {

constexpr std::uint32_t kLength = 4000;

/// Two vertices for each step. The second half of the strip runs back over the first, a tenth of a step above it.
std::vector<float> strip_positions() {
  std::vector<float> xyz;
  for (std::uint32_t step = 0; step < kLength; ++step) {
    const bool back = step >= kLength / 2;
    const auto x = static_cast<float>(back ? kLength - 1 - step : step);
    const float z = back ? 0.1F : 0.0F;
    xyz.insert(xyz.end(), {x, 0.0F, z, x, 1.0F, z});
  }
  return xyz;
}

}  // namespace

int main() {
  const std::vector<float> xyz = strip_positions();
  std::vector<std::uint32_t> offsets = {
      0};  // polygons of any size: face f has the corners [offsets[f], offsets[f + 1])
  std::vector<std::uint32_t> corners;
  for (std::uint32_t step = 0; step + 1 < kLength; ++step) {
    corners.insert(corners.end(), {2 * step, 2 * step + 1, 2 * step + 3, 2 * step + 2});
    offsets.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  const meshhood::MeshView mesh{xyz, meshhood::FacesView::polygons(offsets, corners)};

  const auto index = meshhood::build(mesh);
  meshhood::Searcher searcher(index);
  std::vector<meshhood::VertexId> in_ball;
  meshhood::BallSearcher(mesh.positions).neighborhood(0, 100.0, in_ball);
  const std::size_t along_strip = searcher.count(0, 100.0);
  std::printf("within 100 of vertex 0: %zu by the ball, %zu along the strip\n", in_ball.size(), along_strip);
  return along_strip == 201 && in_ball.size() == 401 ? 0 : 1;
}
