// SPDX-License-Identifier: MIT
#include "batch/rows.h"

#include <string>

#include "meshhood/error.h"

#include "base/distance.h"

namespace meshhood {

Rows::Rows(const BatchQuery& query, std::size_t vertex_count)
    : vertices_(query.vertices), size_(vertices_ ? vertices_->size() : vertex_count) {
  if (const double* radius = std::get_if<double>(&query.radius)) {
    radius_ = *radius;
    check_radius(radius_);
  } else {
    radii_ = std::get<std::span<const double>>(query.radius);
    if (radii_.size() != size_) {
      raise(ErrorCode::InvalidRadius, std::to_string(radii_.size()) + " radii for " + std::to_string(size_) + " rows");
    }
  }
  for (std::size_t row = 0; row < size_; ++row) {
    if (vertex(row) < vertex_count && radius(row) >= 0) [[likely]] {
      continue;
    }
    check_query(vertex(row), vertex_count, radius(row), "row " + std::to_string(row) + ": ");
  }
}

}  // namespace meshhood
