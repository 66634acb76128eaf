// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "exact/layout.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood {

/// Writes the caller's ids of `set`, in index order. `out` has room for `set.count()` ids, and for `kLeafCapacity`
/// more, whose content is unspecified afterwards.
void write_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, VertexId* out);

/// Refills `out` with them.
void replace_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out);

/// Appends them to `out`.
void append_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out);

/// Writes the distances of the same vertices from `center`, in the same order; `set.count()` of them.
void write_distances(const VertexSet& set, const IndexView& index, const Point& center, double* out);

}  // namespace meshhood
