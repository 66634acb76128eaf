// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "meshhood/fingerprint.h"

#include "parts/chunked_mesh.h"
#include "parts/cut_tree.h"
#include "parts/passes.h"

namespace meshhood::parts {

/// The results of the first pass over a mesh.
struct Survey {
  std::uint64_t faces = 0;
  std::uint64_t corners = 0;
  Fingerprint content_hash;
  std::vector<Site> sample;  ///< vertices by which the cuts are chosen
};

/// The number of vertices by which the cuts are chosen. It depends on the number of parts alone, so that a run with
/// another memory cuts alike. The share that a part owns then has a standard deviation of about 2 %.
[[nodiscard]] std::uint64_t sample_size(std::uint64_t parts);

/// Reads the whole mesh once, so that every fault is found before anything is written. The sample has approximately
/// `sample_size(parts)` vertices.
[[nodiscard]] Survey survey(ChunkedMesh& mesh, std::uint64_t parts, Stages& stages);

/// The mean length of the distinct edges: to the last bit what `mean_edge_length` gives for the whole mesh, because the
/// lengths are added in the same order. 0 if there are no edges.
///
/// An external merge sort: the edges of each chunk of `chunk_corners` corners are sorted into a file of `folder`, and
/// the files are merged. Memory: about 100 bytes a corner of a chunk. `corners`, of all faces, is for the progress.
[[nodiscard]] double mean_edge_length(ChunkedMesh& mesh, const std::filesystem::path& folder, std::size_t chunk_corners,
                                      std::uint64_t corners, Stages& stages);

}  // namespace meshhood::parts
