// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A mesh renumbered into index order, with its index. With this order, mesh and index share one copy of the positions,
/// `Index::permutation()` is empty, and vertices that are near on the mesh are near in memory.
struct ReorderedMesh {
  Index index;
  std::vector<VertexId> permutation;            ///< by new vertex: its id in the given mesh. #V
  std::vector<std::uint32_t> face_permutation;  ///< by new face: its number in the given mesh. #F
  std::vector<std::uint32_t> face_offsets;      ///< #F + 1 (see `FacesView`); empty if triangles were given
  std::vector<std::uint32_t> corners;           ///< of each face in the order given, as new ids

  /// Returns the mesh, borrowed from this object. A view of a temporary does not compile.
  [[nodiscard]] MeshView view() const&;
  [[nodiscard]] MeshView view() const&& = delete;
};

/// Builds the index of `mesh` and renumbers the mesh: vertices in index order, faces by their first vertex in it,
/// otherwise in the order given, those without corners last. The result is the same for any number of threads.
///
/// mesh    any polygonal mesh (see `validate`); borrowed for the call.
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}. TooLarge also beyond 2^32 - 1 faces. Takes O(#V log
/// #V + #E + #corners).
[[nodiscard]] ReorderedMesh reorder(const MeshView& mesh, const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
