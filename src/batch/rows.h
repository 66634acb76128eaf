// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/batch.h"

namespace meshhood::inline v0_1 {

/// The passes over all rows, one for each of the scales; the radius itself if there are none.
/// Throws Error{InvalidRadius}, naming the scale, and Error{InvalidOption} if there are scales, but none.
[[nodiscard]] std::vector<BatchRadius> radius_of_passes(const BatchRadius& radius);

/// Memory for `count` ids, and as many distances if they are wanted. Throws Error{InvalidOption} if it is not for
/// these.
[[nodiscard]] BatchMemory allocated(const BatchAllocator& allocate, std::size_t count, bool distances);

/// The rows of a batch, checked. A copy: nothing that the caller changes later has an effect.
class Rows {
 public:
  /// Throws Error{VertexOutOfRange, InvalidRadius}, naming the row, and Error{InvalidRadius} if there are scales.
  Rows(const BatchQuery& query, std::size_t vertex_count);

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Whether row `v` is of vertex `v`, for all vertices.
  [[nodiscard]] bool are_all_vertices() const { return !vertices_; }

  [[nodiscard]] VertexId vertex(std::size_t row) const {
    return vertices_ ? (*vertices_)[row] : static_cast<VertexId>(row);
  }

  [[nodiscard]] double radius(std::size_t row) const { return radii_ ? (*radii_)[row] : radius_; }

  /// Replaces the radius of all rows, each of which has the same.
  void set_radius(double radius) { radius_ = radius; }

  /// Replaces row `i` by the former row `order[i]`. `order` is a permutation of the rows.
  void reorder(std::span<const std::size_t> order);

 private:
  [[nodiscard]] bool are_valid(std::size_t vertex_count) const;

  std::optional<std::vector<VertexId>> vertices_;
  std::optional<std::vector<double>> radii_;
  std::size_t size_;
  double radius_;  // of all rows, unless there are `radii_`
};

}  // namespace meshhood::inline v0_1
