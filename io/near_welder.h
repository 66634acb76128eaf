// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shared/distance.h"

namespace meshhood::inline v0_1::io {

/// Merges vertices at most `eps` > 0 apart, in the order in which they come (see io/weld.h).
///
/// Kept vertices are listed by the cells of a grid, in a hash table of cells. The cells that the ball around a vertex
/// meets have all candidates. A cell is only some `eps` wide, so it has a bounded number of kept vertices.
/// Memory beside the result: 8 to 12 bytes for each vertex that is expected.
template <class Real>
class NearWelder {
 public:
  using Point = std::array<Real, 3>;

  /// `positions` (#V by 3) and `ids` receive the kept vertices, and the number of each vertex among these; both must be
  /// empty and outlive this. `vertices` is how many will come.
  NearWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& ids, std::size_t vertices, double eps);

  /// The coordinates are valid for a mesh.
  void append(const Point& point);

 private:
  /// Coordinates of the cells that the ball meets along one axis: one or two, perhaps equal.
  using Cells = std::array<double, 2>;

  [[nodiscard]] double cell(double coordinate) const;
  [[nodiscard]] Cells cells(double coordinate) const;
  [[nodiscard]] std::size_t bucket(double x, double y, double z) const;
  [[nodiscard]] std::uint32_t first_near(const Point& point) const;
  [[nodiscard]] std::uint32_t first_in(std::size_t bucket, const meshhood::Point& point, std::uint32_t before) const;
  std::uint32_t keep(const Point& point);

  std::vector<Real>& positions_;
  std::vector<std::uint32_t>& ids_;
  double squared_eps_;
  double reach_;       // more than the distance of any two points that the predicate finds at most eps apart
  double cell_width_;  // a power of two
  std::uint64_t seed_;
  std::vector<std::uint32_t> newest_;  // by bucket: the last vertex kept there
  std::vector<std::uint32_t> older_;   // by kept vertex: the one kept before it in its bucket
};

extern template class NearWelder<float>;
extern template class NearWelder<double>;

}  // namespace meshhood::inline v0_1::io
