// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "meshhood/batch.h"

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

}  // namespace meshhood::python
