// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "support/families.h"

namespace meshhood::test {

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
