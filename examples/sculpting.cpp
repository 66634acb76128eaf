// SPDX-License-Identifier: MIT
// A brush on a mesh whose vertices move: each step finds the region under the brush, raises it, and brings the index up
// to date. Nothing is made again.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include <meshhood/meshhood.h>

namespace {

constexpr std::uint32_t kSide = 200;

// [readme]
class Sculpting {
 public:
  Sculpting(std::span<const float> positions, std::span<const std::uint32_t> triangles)
      : positions_(positions.begin(), positions.end()), index_(meshhood::build(positions, triangles)) {}

  /// Raises the surface around a point in space, and returns how many vertices have moved.
  std::size_t raise(const meshhood::SpacePoint& brush, double radius) {
    searcher_.rebind(searched_);
    searcher_.neighborhood(meshhood::Start::nearest(index_, brush), radius, moved_);
    for (const meshhood::VertexId v : moved_) positions_[3 * std::size_t{v} + 2] += 0.1F;
    index_.refit_in_place(positions_, moved_);                 // only these have moved
    searched_ = meshhood::masked(index_, {.walls = frozen_});  // what the brush does not pass
    return moved_.size();
  }

  void freeze(std::size_t vertex) {
    frozen_[vertex] = true;
    searched_ = meshhood::masked(index_, {.walls = frozen_});
  }

 private:
  std::vector<float> positions_;
  meshhood::Index index_;
  std::vector<bool> frozen_ = std::vector<bool>(index_.vertex_count());
  meshhood::Index searched_ = meshhood::masked(index_, {.walls = frozen_});
  meshhood::Searcher searcher_{searched_};
  std::vector<meshhood::VertexId> moved_;
};
// [readme]

}  // namespace

int main() {
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t v = 0; v < kSide * kSide; ++v) {
    const std::uint32_t column = v % kSide;
    const std::uint32_t row = v / kSide;
    positions.insert(positions.end(), {static_cast<float>(column), static_cast<float>(row), 0.0F});
    if (column + 1 == kSide || row + 1 == kSide) continue;
    triangles.insert(triangles.end(), {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide});
  }
  Sculpting sculpting(positions, triangles);
  for (std::size_t row = 0; row < kSide; ++row) sculpting.freeze(row * kSide + 103);
  std::size_t first = 0;
  std::size_t last = 0;
  for (int step = 0; step < 30; ++step) {
    last = sculpting.raise({100, 100, 0.1 * step}, 5);
    if (step == 0) first = last;
  }
  std::printf("%zu vertices move in the first step, %zu in the last\n", first, last);
  return first == 64 && last > 40 ? 0 : 1;
}
