// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "meshhood/batch.h"

namespace meshhood {

/// What a batch asks for, checked, row by row.
class Rows {
 public:
  /// Throws Error{VertexOutOfRange, InvalidRadius}, naming the row.
  Rows(const BatchQuery& query, std::size_t vertex_count);

  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] VertexId vertex(std::size_t row) const {
    return vertices_ ? (*vertices_)[row] : static_cast<VertexId>(row);
  }

  [[nodiscard]] double radius(std::size_t row) const { return radii_.empty() ? radius_ : radii_[row]; }

 private:
  std::optional<std::span<const VertexId>> vertices_;
  std::size_t size_;
  std::span<const double> radii_;
  double radius_ = 0;  // of all rows, where `radii_` is empty
};

}  // namespace meshhood
