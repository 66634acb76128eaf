// SPDX-License-Identifier: MIT
#include "batch/rows.h"

#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "base/distance.h"

namespace meshhood {
namespace {

template <class T>
std::optional<std::vector<T>> copy(const std::optional<std::span<const T>>& list) {
  if (!list) return std::nullopt;
  return std::vector<T>(list->begin(), list->end());
}

}  // namespace

Rows::Rows(const BatchQuery& query, std::size_t vertex_count)
    : vertices_(copy(query.vertices.list())),
      radii_(copy(query.radius.list())),
      size_(vertices_ ? vertices_->size() : vertex_count),
      radius_(query.radius.common()) {
  if (!radii_) {
    check_radius(radius_);
  } else if (radii_->size() != size_) {
    raise(ErrorCode::InvalidRadius, std::to_string(radii_->size()) + " radii for " + std::to_string(size_) + " rows");
  }
  for (std::size_t row = 0; row < size_; ++row) {
    if (vertex(row) < vertex_count && radius(row) >= 0) [[likely]] {
      continue;
    }
    check_query(vertex(row), vertex_count, radius(row), "row " + std::to_string(row) + ": ");
  }
}

void Rows::reorder(std::span<const std::size_t> order) {
  std::vector<VertexId> vertices;
  vertices.reserve(size_);
  for (const std::size_t row : order) vertices.push_back(vertex(row));
  if (radii_) {
    std::vector<double> radii;
    radii.reserve(size_);
    for (const std::size_t row : order) radii.push_back((*radii_)[row]);
    radii_ = std::move(radii);
  }
  vertices_ = std::move(vertices);
}

}  // namespace meshhood
