// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "index/layout.h"
#include "search/answer.h"
#include "search/simd.h"

namespace meshhood {

[[nodiscard]] std::size_t count(const Answer& answer);

/// Refills `out` with the caller's ids, in the order of the answer.
void write_ids(const Answer& answer, const IndexStorage& index, const Kernels& kernels, std::vector<VertexId>& out);

/// Refills `out` with the distances from `centre`, in the same order.
void write_distances(const Answer& answer, const IndexStorage& index, const Point& centre, std::vector<double>& out);

/// Appends the parts to the runs.
void append_parts_as_runs(const IndexStorage& index, Answer& answer);

}  // namespace meshhood
