// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/batch.h"

#include "arguments.h"

/// The arguments that every call on many vertices begins with, as JavaScript passes them (bindings/wasm/rows.js).
namespace meshhood::wasm {

/// By what rows are found. `search_by` sets it before a call.
inline Metric row_metric = Metric::Straight;

struct RowArguments {
  const VertexId* vertices;  ///< null for all
  std::size_t vertex_count;
  double radius;        ///< of all rows, unless there is a list
  const double* radii;  ///< null, or the radii
  std::size_t radius_count;
  bool are_scales;  ///< whether each of the radii is that of all rows; otherwise there is one for each row

  /// Borrows the lists.
  [[nodiscard]] BatchQuery query() const {
    BatchQuery query{.vertices = view_vertices(vertices, vertex_count), .radius = radius, .metric = row_metric};
    const std::span list(radii, radius_count);
    if (are_scales) {
      query.radius = BatchRadius::scales({list.begin(), list.end()});
    } else if (radii != nullptr) {
      query.radius = list;
    }
    return query;
  }
};

}  // namespace meshhood::wasm
