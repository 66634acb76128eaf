// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
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

/// Reads the whole mesh once, so that every fault is found before anything is written.
///
/// sample  the number of vertices in the sample, approximately.
[[nodiscard]] Survey survey(ChunkedMesh& mesh, std::uint64_t sample, Stages& stages);

}  // namespace meshhood::parts
