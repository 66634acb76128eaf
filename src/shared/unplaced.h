// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {

struct FaceCorner {
  std::size_t face;
  std::size_t corner;
  VertexId vertex;

  /// Returns why the corner is refused. Elements are counted from `first`, 0 or 1.
  [[nodiscard]] std::string text(std::size_t first = 0) const {
    return "vertex " + std::to_string(vertex + first) + " has no position (NaN), but face " +
           std::to_string(face + first) + " has it as corner " + std::to_string(corner + first);
  }
};

/// The vertices of a mesh without a position: a coordinate is NaN. Scanners and depth cameras mark holes by them.
struct Unplaced {
  std::vector<std::uint8_t> walls;  ///< #V, 1 for each of them, as `Masks` takes it; empty if there are none
  std::size_t count = 0;
  VertexId first = 0;              ///< of them
  std::optional<FaceCorner> used;  ///< the first corner that is one of them: then the mesh is to be refused
};

/// Returns the first corner of a face that `walls` has.
[[nodiscard]] inline std::optional<FaceCorner> first_corner_of(const FacesView& faces,
                                                               std::span<const std::uint8_t> walls) {
  std::optional<FaceCorner> found;
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    for (std::size_t i = 0; i < corners.size() && !found; ++i) {
      if (walls[corners[i]] != 0) found = FaceCorner{face, i, corners[i]};
    }
  });
  return found;
}

/// Finds the vertices without a position, and moves them to the first vertex with one, where they change no bounds, or
/// to the origin if there is none. If it finds some, it throws as `validate` unless the rest is a mesh.
/// O(#V + #corners).
template <class Real>
[[nodiscard]] Unplaced place(std::span<Real> xyz, const FacesView& faces) {
  Unplaced unplaced;
  std::optional<std::size_t> placed;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    if (!std::isnan(xyz[3 * v]) && !std::isnan(xyz[3 * v + 1]) && !std::isnan(xyz[3 * v + 2])) {
      if (!placed) placed = v;
      continue;
    }
    if (unplaced.count++ == 0) unplaced.first = static_cast<VertexId>(v);
    unplaced.walls.resize(xyz.size() / 3);
    unplaced.walls[v] = 1;
  }
  if (unplaced.count == 0) return unplaced;
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    if (unplaced.walls[i / 3] != 0) xyz[i] = placed ? xyz[3 * *placed + i % 3] : Real{0};
  }
  validate(MeshView{PositionsView(std::span<const Real>(xyz)), faces});
  unplaced.used = first_corner_of(faces, unplaced.walls);
  return unplaced;
}

}  // namespace meshhood::inline v0_1
