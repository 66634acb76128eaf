// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "meshhood/batch.h"
#include "meshhood/error.h"

namespace meshhood::python {

using Rows = nanobind::ndarray<const std::int32_t, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>;
using Radii = nanobind::ndarray<const double, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>;

/// The query of a batch. Borrows the arrays.
[[nodiscard]] inline BatchQuery query_of(const std::optional<Rows>& vertices,
                                         const std::variant<double, Radii>& radius) {
  BatchQuery query;
  if (vertices) query.vertices = std::span(reinterpret_cast<const VertexId*>(vertices->data()), vertices->size());
  if (const auto* const radii = std::get_if<Radii>(&radius)) {
    query.radius = std::span(radii->data(), radii->size());
  } else {
    query.radius = std::get<double>(radius);
  }
  return query;
}

/// A result beyond the limit of bytes: a MemoryError in Python.
class ResultTooLarge : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls `f`, whose result alone may be too large.
template <class F>
auto limited(F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::TooLarge) throw;
    throw ResultTooLarge(std::string(error.what()) + "; iter_neighborhoods returns the rows in chunks");
  }
}

}  // namespace meshhood::python
