// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/masks.h"
#include "meshhood/start.h"

#include "support/random.h"
#include "support/region_oracle.h"
#include "support/test_mesh.h"

namespace meshhood::test {

/// A random start for the oracle and for the library.
struct DrawnStart {
  PlainStart plain;
  bool is_vertex = false;
  bool has_masks = false;

  [[nodiscard]] Start start() const { return is_vertex ? Start(plain.seeds[0]) : Start(plain.center, plain.seeds); }

  /// The index of these masks; without masks a copy of it.
  [[nodiscard]] Index on(const Index& index) const {
    return masked(index, has_masks ? Masks{.walls = plain.walls, .ignored = plain.ignored} : Masks{});
  }
};

inline std::array<double, 3> position(const TestMesh& mesh, std::size_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

/// Marks about one in `rarity` vertices; none if that is 0.
inline std::vector<std::uint8_t> draw_mask(Random& random, std::size_t vertices, std::size_t rarity) {
  std::vector<std::uint8_t> mask(vertices);
  for (std::uint8_t& byte : mask) byte = rarity != 0 && random.below(rarity) == 0 ? 255 : 0;
  return mask;
}

/// A vertex, a point on a face, or any point near the mesh with some seeds; without masks, or with. The mesh has
/// vertices.
inline DrawnStart draw_start(Random& random, const TestMesh& mesh) {
  DrawnStart drawn;
  const auto any = [&] { return static_cast<std::uint32_t>(random.below(mesh.size())); };
  drawn.has_masks = random.below(2) == 0;
  drawn.plain.walls = draw_mask(random, mesh.size(), drawn.has_masks ? 4 + random.below(30) : 0);
  drawn.plain.ignored = draw_mask(random, mesh.size(), drawn.has_masks ? 3 : 0);
  const std::uint32_t v = any();
  drawn.plain.center = position(mesh, v);
  drawn.plain.seeds = {v};
  drawn.is_vertex = random.below(3) == 0;
  if (drawn.is_vertex) return drawn;
  const auto other = position(mesh, any());
  const double weight = random.uniform();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drawn.plain.center[axis] = (1 - weight) * drawn.plain.center[axis] + weight * other[axis];
  }
  while (random.below(2) == 0) drawn.plain.seeds.push_back(any());
  return drawn;
}

}  // namespace meshhood::test
