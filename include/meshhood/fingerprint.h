// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// Identifies a mesh: a hash of 128 bits over its positions, in their precision and bit for bit, and its graph. Meshes
/// with the same positions and graph have the same fingerprint, whatever the order of faces and corners. It detects
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

/// The graph must be valid. O(#V + #E).
[[nodiscard]] Fingerprint fingerprint(const GraphView& graph);

}  // namespace meshhood
