// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/distance.h"

namespace meshhood::inline v0_1::io {

/// Merges vertices at most `eps` apart, in the order in which they come (see io/weld.h).
///
/// Kept vertices are listed by the cells of a grid, in a hash table of cells. The cells that the ball around a vertex
/// meets have all candidates. A cell is only some `eps` wide, so it has a bounded number of kept vertices; with an
/// `eps` of 0, each position is a cell. The hash differs from run to run, so that no file can be made that is slow to
/// weld; the result does not depend on it. Expected O(n). Memory beside the result: 8 to 12 bytes for each vertex that
/// there is or is expected.
template <class Real>
class Welder {
 public:
  using Point = std::array<Real, 3>;

  /// `positions` (#V by 3) and `ids` receive the kept vertices, and the number of each vertex among these; both must be
  /// empty and outlive this. `file` is for messages.
  Welder(std::vector<Real>& positions, std::vector<std::uint32_t>& ids, std::string file, double eps = 0);

  /// Makes the table large enough for so many vertices.
  void expect(std::size_t vertices);

  /// The coordinates are valid for a mesh, or with an `eps` of 0 finite. Throws Error{TooLarge}.
  void append(const Point& point);

 private:
  /// Coordinates of the cells that the ball meets along one axis: one or two, perhaps equal.
  using Cells = std::array<double, 2>;

  [[nodiscard]] double cell(double coordinate) const;
  [[nodiscard]] Cells cells(double coordinate) const;
  [[nodiscard]] std::size_t bucket(double x, double y, double z) const;
  [[nodiscard]] meshhood::Point kept(std::uint32_t id) const {
    const Real* const xyz = &positions_[3 * std::size_t{id}];
    return {double{xyz[0]}, double{xyz[1]}, double{xyz[2]}};
  }
  [[nodiscard]] std::uint32_t first_near(const meshhood::Point& point) const;
  [[nodiscard]] std::uint32_t first_in(std::size_t bucket, const meshhood::Point& point, std::uint32_t before) const;
  std::uint32_t keep(const Point& point);
  void list(std::uint32_t id);
  void resize(std::size_t buckets);

  std::vector<Real>& positions_;
  std::vector<std::uint32_t>& ids_;
  std::string file_;
  bool is_exact_;  // only equal positions are near
  double squared_eps_;
  double reach_;       // more than the distance of any two points that the predicate finds at most eps apart
  double cell_width_;  // a power of two
  std::uint64_t seed_;
  std::vector<std::uint32_t> newest_;  // by bucket: the last vertex kept there; a power of two, no fewer than vertices
  std::vector<std::uint32_t> older_;   // by kept vertex: the one kept before it in its bucket
};

extern template class Welder<float>;
extern template class Welder<double>;

}  // namespace meshhood::inline v0_1::io
