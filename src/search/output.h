// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "index/layout.h"
#include "search/answer.h"
#include "search/simd.h"

namespace meshhood {

[[nodiscard]] std::size_t count(const Answer& answer);

/// Writes the caller's ids, in the order of the answer. `out` has room for `count` of them, and for `kLeafCapacity`
/// more that it may use.
void write_ids(const Answer& answer, const IndexStorage& index, const Kernels& kernels, VertexId* out);

/// Writes the distances from `centre`, `count` of them, in the same order.
void write_distances(const Answer& answer, const IndexStorage& index, const Point& centre, double* out);

/// Appends the parts to the runs.
void append_parts_as_runs(const IndexStorage& index, Answer& answer);

}  // namespace meshhood
