// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "simd/joint.h"
#include "simd/kernels.h"

/// The inner loops of shortest paths from up to 32 vertices at once. As in `Kernels`, each function gives the same
/// result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

/// The lengths of the shortest paths to a vertex so far, one for each query of a packet. Infinite where there is none.
using PathLengths = PerLane<double>;

/// An edge to a vertex, by the number that the search gives it.
struct PathEdge {
  double length;
  std::uint32_t end;
};

struct PathKernels {
  /// Follows up to 32 edges from a vertex, for all queries: where the path over an edge is shorter, its length replaces
  /// that at the end of the edge. Returns the set of edges, by their place in `edges`, at whose ends some length became
  /// shorter. `all`: the lengths by vertex; `from`: those of the vertex, which is the end of none of the edges.
  std::uint32_t (*follow_edges)(const PathLengths& from, std::span<const PathEdge> edges, PathLengths* all);

  /// The queries whose path to a vertex is at most as long as their limit.
  QueryWord (*within_limits)(const PathLengths& lengths, const PathLengths& limits);
};

/// Those for `isa`, which the processor must have.
[[nodiscard]] const PathKernels& path_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
