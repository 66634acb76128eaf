// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parts/chunked_mesh.h"
#include "parts/cut_tree.h"
#include "parts/stages.h"
#include "shared/distance.h"

/// Passes over the vertices of a chunked mesh, with progress.
namespace meshhood::parts {

/// The number of vertices that are read at once. Fixed, because the content hash depends on it.
inline constexpr std::size_t kVertexChunk = std::size_t{1} << 16;

/// Calls `f(first, positions)` for all vertices, a chunk at a time.
template <class F>
void for_each_vertex_chunk(ChunkedMesh& mesh, Stages& stages, F&& f) {
  std::vector<Point> positions;
  for (std::uint64_t first = 0; first < mesh.vertex_count(); first += positions.size()) {
    positions.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kVertexChunk, mesh.vertex_count() - first)));
    mesh.read_positions(first, positions);
    f(first, std::span<const Point>(positions));
    stages.report(first + positions.size(), mesh.vertex_count());
  }
}

/// The same for single vertices: `f(site)`.
template <class F>
void for_each_vertex(ChunkedMesh& mesh, Stages& stages, F&& f) {
  for_each_vertex_chunk(mesh, stages, [&](std::uint64_t first, std::span<const Point> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) f(Site{positions[i], first + i});
  });
}

}  // namespace meshhood::parts
