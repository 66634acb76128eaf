// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/mesh_data.h"

/// Welding: makes one vertex of all vertices at the same place, so that faces which meet there are connected.
///
/// Vertices are taken in ascending order of their ids. A vertex becomes the first kept vertex at most `eps` away; if
/// there is none, it is kept. So kept vertices are more than `eps` apart, every vertex is at most `eps` away from the
/// one that it becomes, no chain of near vertices collapses, and welding again with the same `eps` changes nothing.
/// With an `eps` > 0 the choice depends on the order of the vertices; with 0 only their numbers do.
///
/// eps  >= 0 and finite, in the unit of the positions. With 0, positions must be equal, where -0 equals 0; otherwise
///      `distance` decides, and a vertex at exactly `eps` is welded.
///
/// Expected O(#V + #corners) if `eps` is no larger than the mean edge length, and that is at least 1e-150, on one
/// thread. The result does not depend on the machine. Throws Error{InvalidOption, InvalidMesh, TooLarge}.
namespace meshhood::inline v0_1::io {
MESHHOOD_API_BEGIN

/// A welded mesh. Kept vertices have their positions, in the precision given, and their order. Offsets are empty if
/// triangles were given.
struct WeldedMesh : MeshData {
  std::vector<std::uint32_t> ids;  ///< by vertex of the mesh given: its id in this one. #V
};

/// All faces stay, in their order, and keep the number of their corners: values by face or by corner remain valid. A
/// face whose corners were welded with each other repeats a vertex, which no search minds.
[[nodiscard]] WeldedMesh weld(const MeshView& mesh, double eps = 0);

/// The `ids` that `weld` returns. O(#V).
[[nodiscard]] std::vector<std::uint32_t> welded_ids(const PositionsView& positions, double eps = 0);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1::io
