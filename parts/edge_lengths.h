// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "parts/chunked_mesh.h"

namespace meshhood::parts {

/// The mean length of the distinct edges: to the last bit what `mean_edge_length` gives for the whole mesh, because the
/// lengths are added in the same order. 0 if there are no edges.
///
/// An external merge sort: the edges of each chunk of `corners` corners are sorted into a file of `folder`, and the
/// files are merged. Memory: about 100 bytes a corner of a chunk. `advance(corners)` is called after each chunk,
/// and with 0 while the files are merged.
[[nodiscard]] double mean_edge_length(ChunkedMesh& mesh, const std::filesystem::path& folder, std::size_t corners,
                                      const std::function<void(std::size_t)>& advance);

}  // namespace meshhood::parts
