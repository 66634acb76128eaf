// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "meshhood/run.h"

#include "parts/chunked_mesh.h"
#include "parts/manifest.h"

namespace meshhood::parts {

struct PartitionOptions {
  /// The number of parts, or the most vertices that a part owns, approximately. One of them is 0.
  std::uint64_t parts = 0;
  std::uint64_t vertices_per_part = 0;

  /// Required: the largest radius that the parts answer, finite and >= 0.
  double halo = 0;

  /// The unit of `halo` is the mean edge length of the mesh, not that of the positions.
  bool halo_in_edges = false;

  /// The most bytes of memory, including the index of a part while it is built. At least `kLeastMemory`.
  std::uint64_t memory = std::uint64_t{1} << 30;

  /// Keep the parts that an earlier run on the same mesh with the same halo and number of parts has finished.
  /// Otherwise they are removed.
  bool resume = true;
};

inline constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 20;

struct PartitionResult {
  Manifest manifest;
  std::size_t kept = 0;  ///< parts of an earlier run
  std::vector<std::string> warnings;
};

/// Cuts a mesh into parts with a halo and writes them to `folder`, which is created if it does not exist.
///
/// A part owns the vertices of a cell of a kd-tree. It also has every vertex and face within the halo of one that it
/// owns, and the fringe: the other corners of these faces. For a vertex that it owns it therefore gives the
/// neighborhood of any radius up to the halo, exactly, every face around the vertices of it, and every face that its
/// ball reaches.
///
/// The mesh is read in chunks: five passes over the positions and three over the faces. Memory stays within
/// `options.memory`; temporary files in `folder` take about 100 bytes for each vertex of a triangle mesh of all parts.
/// They are removed at the end, also after an error. A part appears whole or not at all, and the manifest last. The
/// same mesh and options give the same files, for any amount of memory and number of threads.
///
/// Throws Error{InvalidOption, InvalidRadius}; what `ChunkedMesh` throws; Error{IoFailure}, also if another run writes
/// into `folder`; Error{MalformedIndex} if `folder` has the parts of another mesh, halo or number of parts, or
/// files but no mark, or a part has a file that no partition has written; Error{TooLarge} if a part needs more memory;
/// Error{Cancelled}. O(#V log #V + #F log #F) in memory of fixed size.
PartitionResult partition(ChunkedMesh& mesh, const std::filesystem::path& folder, const PartitionOptions& options,
                          const Run& run = {});

}  // namespace meshhood::parts
