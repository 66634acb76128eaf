// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {

/// Positions row by row: those given, or a copy if they are strided.
template <class Real>
class PackedPositions {
 public:
  explicit PackedPositions(const StridedPositions<Real>& xyz) {
    if (xyz.is_packed()) {
      view_ = xyz.packed();
      return;
    }
    copy_.reserve(3 * xyz.size());
    for (std::size_t v = 0; v < xyz.size(); ++v) copy_.insert(copy_.end(), {xyz(v, 0), xyz(v, 1), xyz(v, 2)});
    view_ = copy_;
  }
  PackedPositions(const PackedPositions&) = delete;
  PackedPositions& operator=(const PackedPositions&) = delete;
  ~PackedPositions() = default;

  /// Returns the positions, #V by 3.
  [[nodiscard]] std::span<const Real> view() const { return view_; }

 private:
  std::vector<Real> copy_;
  std::span<const Real> view_;
};

/// Returns the positions of `vertices`, #vertices by 3, from `xyz`, #V by 3. A place in `xyz` may need more bits than
/// an id.
template <class Real>
[[nodiscard]] std::vector<Real> rows_of(std::span<const Real> xyz, std::span<const VertexId> vertices) {
  std::vector<Real> rows;
  rows.reserve(3 * vertices.size());
  for (const VertexId v : vertices) {
    const auto row = xyz.subspan(3 * std::size_t{v}, 3);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  return rows;
}

}  // namespace meshhood::inline v0_1
