// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// What a mesh is known by: a hash of 128 bits over its positions, in their precision and bit for bit, and its graph.
/// The same for all meshes with these positions and this graph, whatever the order of their faces and corners. It finds
/// mistakes, not forgeries.
struct Fingerprint {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

/// 32 hexadecimal digits.
[[nodiscard]] std::string to_text(const Fingerprint& fingerprint);

/// Throws Error{InvalidMesh, TooLarge}, as `adjacency`. O(#V + #corners log(valence)).
[[nodiscard]] Fingerprint fingerprint(const MeshView& mesh);

/// The graph is valid. O(#V + #E).
[[nodiscard]] Fingerprint fingerprint(const GraphView& graph);

/// That of the mesh which the index was built from. O(#V + #E log(valence)), and as much memory as
/// `extract_graph(index)`.
[[nodiscard]] Fingerprint fingerprint(const Index& index);

}  // namespace meshhood
