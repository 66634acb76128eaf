// SPDX-License-Identifier: MIT
#include "batch/rows.h"

#include <cassert>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

template <class T>
std::optional<std::vector<T>> copy(const std::optional<std::span<const T>>& list) {
  if (!list) return std::nullopt;
  return std::vector<T>(list->begin(), list->end());
}

}  // namespace

std::size_t BatchQuery::result_rows(std::size_t vertex_count, std::size_t columns) const {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
  const std::size_t radii = radius.scales() ? radius.scales()->size() : 1;
  const std::size_t rows = vertices.count(vertex_count);
  if (rows != 0 && columns != 0 && radii > kMost / rows / columns) {
    raise(ErrorCode::TooLarge, "the result of " + std::to_string(radii) + " radii by " + std::to_string(rows) +
                                   " rows by " + std::to_string(columns) + " columns, expected at most " +
                                   std::to_string(kMost) + " numbers");
  }
  return radii * rows;
}

std::vector<BatchRadius> radius_of_passes(const BatchRadius& radius) {
  if (!radius.scales()) return {radius};
  if (radius.scales()->empty()) raise(ErrorCode::InvalidOption, "there are no radii, expected at least one");
  std::vector<BatchRadius> passes;
  for (const double scale : *radius.scales()) {
    check_radius(scale, "radius " + std::to_string(passes.size()) + ": ");
    passes.emplace_back(scale);
  }
  return passes;
}

BatchMemory allocated(const BatchAllocator& allocate, std::size_t count, bool distances) {
  const BatchMemory memory = allocate(count);
  const auto verify = [count](std::size_t size, const char* what) {
    if (size == count) return;
    raise(ErrorCode::InvalidOption,
          "memory for " + std::to_string(size) + what + ", expected for " + std::to_string(count));
  };
  verify(memory.ids.size(), " ids");
  if (distances) verify(memory.distances.size(), " distances");
  return memory;
}

Rows::Rows(const BatchQuery& query, std::size_t vertex_count)
    : vertices_(copy(query.vertices.list())),
      radii_(copy(query.radius.list())),
      size_(vertices_ ? vertices_->size() : vertex_count),
      radius_(query.radius.common()) {
  if (query.radius.scales()) {
    raise(ErrorCode::InvalidRadius, "several radii for all rows, expected one, or one for each row");
  }
  if (!radii_) {
    check_radius(radius_);
  } else if (radii_->size() != size_) {
    raise(ErrorCode::InvalidRadius, std::to_string(radii_->size()) + " radii for " + std::to_string(size_) + " rows");
  }
  if (are_valid(vertex_count)) return;
  for (std::size_t row = 0; row < size_; ++row) {
    check_query(vertex(row), vertex_count, radius(row), "row " + std::to_string(row) + ": ");
  }
}

// Has no branches, so that compilers use vectors.
bool Rows::are_valid(std::size_t vertex_count) const {
  bool result = true;
  for (const VertexId v : vertices_ ? std::span<const VertexId>(*vertices_) : std::span<const VertexId>()) {
    result &= v < vertex_count;
  }
  for (const double radius : radii_ ? std::span<const double>(*radii_) : std::span<const double>()) {
    result &= radius >= 0;
  }
  return result;
}

void Rows::reorder(std::span<const std::size_t> order) {
  assert(order.size() == size_);
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

}  // namespace meshhood::inline v0_1
