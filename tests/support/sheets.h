// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/families.h"

/// Sheets whose parts are joined by a narrow way, or far from the query vertex, and a sheet that folds back.
namespace meshhood::test {

/// The part of a grid of `rows` by `columns` vertices where `is_there(x, y)`.
template <class IsThere>
TestMesh cut_grid(std::uint32_t columns, std::uint32_t rows, IsThere&& is_there) {
  const TestMesh grid = make_grid(columns, rows, false);
  const auto is_kept = [&](std::uint32_t v) { return is_there(v % columns, v / columns); };
  TestMesh mesh;
  std::vector<std::uint32_t> ids(grid.size());
  for (std::uint32_t v = 0; v < grid.size(); ++v) {
    if (is_kept(v))
      ids[v] = mesh.add_vertex(grid.positions[3 * std::size_t{v}], grid.positions[3 * std::size_t{v} + 1], 0);
  }
  for (std::size_t f = 0; f < grid.face_count(); ++f) {
    const auto face = grid.face(f);
    if (std::all_of(face.begin(), face.end(), is_kept)) mesh.add_face({ids[face[0]], ids[face[1]], ids[face[2]]});
  }
  return mesh.finish(true);
}

/// A strip of `width` by `length` vertices, and another one beside it, joined at one end: like a hairpin.
inline TestMesh make_hairpin(std::uint32_t width, std::uint32_t gap, std::uint32_t length) {
  return cut_grid(2 * width + gap, length, [=](std::uint32_t x, std::uint32_t y) {
    return x < width || x >= width + gap || y >= length - width;
  });
}

/// A sheet of `side` by twice as many vertices, in rows, that folds back over itself behind row `side - 1`. The upper
/// half is at a height of 0.7, plus waves of the given height and 12 edges long.
inline TestMesh make_folded_sheet(std::size_t side, double waves = 0) {
  TestMesh mesh = make_grid(2 * side, side, false);
  const auto fold = static_cast<double>(side - 1);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    double& y = mesh.positions[i + 1];
    if (y <= fold) continue;
    y = 2 * fold + 1 - y;
    mesh.positions[i + 2] = 0.7 + waves * (2 + std::cos(mesh.positions[i] * 0.5) + std::cos(y * 0.5));
  }
  return mesh.finish(true);
}

}  // namespace meshhood::test
