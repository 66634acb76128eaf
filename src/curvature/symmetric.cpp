// SPDX-License-Identifier: MIT
#include "curvature/symmetric.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/vector.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Makes element (p, q) 0 by a rotation of rows and columns p and q; `vectors` has the axes as columns.
void rotate_to_zero(Matrix3& a, Matrix3& vectors, std::size_t p, std::size_t q) {
  const JacobiRotation rotation(a[p][p], a[q][q], a[p][q]);
  for (std::size_t i = 0; i < 3; ++i) rotation.turn(a[i][p], a[i][q]);
  for (std::size_t i = 0; i < 3; ++i) rotation.turn(a[p][i], a[q][i]);
  for (std::size_t i = 0; i < 3; ++i) rotation.turn(vectors[i][p], vectors[i][q]);
  a[p][q] = a[q][p] = 0;
}

}  // namespace

Eigen3 eigen(const Symmetric3& m) {
  const double size =
      std::max({std::abs(m.xx), std::abs(m.xy), std::abs(m.xz), std::abs(m.yy), std::abs(m.yz), std::abs(m.zz)});
  if (!std::isfinite(size + m.xx + m.xy + m.xz + m.yy + m.yz + m.zz)) {
    return {{kNan, kNan, kNan}, {Point{kNan, kNan, kNan}, {kNan, kNan, kNan}, {kNan, kNan, kNan}}};
  }
  Matrix3 a{{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}};
  Matrix3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kMostSweeps = 30;
  const double negligible = 0x1p-60 * size;
  const auto off = [&] { return std::max({std::abs(a[0][1]), std::abs(a[0][2]), std::abs(a[1][2])}); };
  for (int sweep = 0; sweep < kMostSweeps && off() > negligible; ++sweep) {
    for (const auto& [p, q] : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) > negligible) rotate_to_zero(a, vectors, p, q);
    }
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return std::pair(a[i][i], i) < std::pair(a[j][j], j); });
  Eigen3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t from = order[i];
    result.values[i] = a[from][from];
    result.vectors[i] = {vectors[0][from], vectors[1][from], vectors[2][from]};
  }
  return result;
}

}  // namespace meshhood::inline v0_1
