// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Identifies a mesh: a 128-bit hash of its positions, bit for bit and in their precision, and of its graph. It does
/// not depend on the order of faces and corners, nor on the layout of the positions in memory. It detects mistakes, not
/// forgeries.
struct Fingerprint {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

/// Returns the fingerprint as 32 hexadecimal digits.
[[nodiscard]] std::string to_text(const Fingerprint& fingerprint);

/// Computes the fingerprint. Throws Error{InvalidMesh, TooLarge}, as `adjacency`. Takes O(#V + #corners log(valence)).
[[nodiscard]] Fingerprint fingerprint(const MeshView& mesh);

/// The graph must be valid. Takes O(#V + #E).
[[nodiscard]] Fingerprint fingerprint(const GraphView& graph);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
