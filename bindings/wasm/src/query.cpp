// SPDX-License-Identifier: MIT
// Neighborhoods of vertices by any method.
#include <cstddef>
#include <span>
#include <utility>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

extern "C" {

/// Returns the number of ids.
[[clang::export_name("query")]] std::size_t query(MethodName method, VertexId v, double radius, bool with_distances) {
  AnySearcher& searcher = workspace.method(method).searcher;
  if (with_distances) {
    searcher.neighborhood(v, radius, answer.ids, answer.reals);
  } else {
    searcher.neighborhood(v, radius, answer.ids);
  }
  return answer.ids.size();
}

[[clang::export_name("count")]] std::size_t count(MethodName method, VertexId v, double radius) {
  return workspace.method(method).searcher.count(v, radius);
}

/// All vertices if `vertices` is null, and `radius` for all rows if `radii` is null. The counts of the answer are the
/// offsets of the rows; with `count_only`, their sizes.
[[clang::export_name("batch")]] void batch(MethodName method, const VertexId* vertices, std::size_t vertex_count,
                                           double radius, const double* radii, std::size_t radius_count,
                                           bool count_only, bool with_distances, bool sorted) {
  BatchQuery query{.vertices = view_vertices(vertices, vertex_count), .radius = radius};
  if (radii != nullptr) query.radius = std::span(radii, radius_count);
  const SearchMethod& search = workspace.method(method).search;
  if (count_only) {
    const auto sizes = counts(search, query);
    answer.counts.assign(sizes.begin(), sizes.end());
    return;
  }
  Neighborhoods rows = neighborhoods(search, query, {.distances = with_distances, .sorted = sorted});
  answer.counts.assign(rows.offsets.begin(), rows.offsets.end());
  answer.ids = std::move(rows.ids);
  answer.reals = std::move(rows.distances);
}

}  // extern "C"

}  // namespace meshhood::wasm
