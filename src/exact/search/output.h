// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "exact/layout.h"
#include "exact/search/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

[[nodiscard]] std::size_t count(const VertexSet& answer);

/// Writes the caller's ids, in the order of the answer. `out` has room for `count` of them, and for `kLeafCapacity`
/// more that it may use.
void write_ids(const VertexSet& answer, const IndexView& index, const Kernels& kernels, VertexId* out);

/// Writes the distances from `centre`, `count` of them, in the same order.
void write_distances(const VertexSet& answer, const IndexView& index, const Point& centre, double* out);

/// Appends the parts to the runs.
void append_subsets_as_runs(const IndexView& index, VertexSet& answer);

}  // namespace meshhood
