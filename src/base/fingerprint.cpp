// SPDX-License-Identifier: MIT
#include "meshhood/fingerprint.h"

#include <array>
#include <span>
#include <string_view>

#include "base/packed_positions.h"
#include "shared/checksum.h"

namespace meshhood::inline v0_1 {

std::string to_text(const Fingerprint& fingerprint) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  for (const std::uint64_t half : {fingerprint.high, fingerprint.low}) {
    for (int shift = 60; shift >= 0; shift -= 4) result += kDigits[half >> shift & 15U];
  }
  return result;
}

Fingerprint fingerprint(const MeshView& mesh) {
  const Adjacency graph = adjacency(mesh);
  return fingerprint({mesh.positions, graph.view()});
}

Fingerprint fingerprint(const GraphView& graph) {
  return graph.positions.visit([&]<class Real>(const StridedPositions<Real>& xyz) {
    const PackedPositions<Real> packed(xyz);
    const std::span<const Real> scalars = packed.view();
    // The sizes separate the arrays: without them, two meshes could have the same bytes.
    const std::array<std::uint64_t, 3> sizes{sizeof(Real), scalars.size(), graph.adjacency.neighbors.size()};
    const AdjacencyView& adjacency = graph.adjacency;
    // A graph without vertices has one offset, or none.
    const auto ends = adjacency.offsets.last(adjacency.size());
    return wide_checksum({std::as_bytes(std::span(sizes)), std::as_bytes(scalars), std::as_bytes(ends),
                          std::as_bytes(adjacency.neighbors)});
  });
}

}  // namespace meshhood::inline v0_1
