// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// A mesh in index order, and the index over it. Who adopts this order holds the positions once, for the mesh and the
/// index, and no map from one to the other: the ids of the index are places in `Index::positions()`, and its
/// `permutation()` is empty. What lies near each other on the mesh lies near each other in memory.
struct ReorderedMesh {
  Index index;
  std::vector<VertexId> permutation;            ///< by vertex: the vertex of the given mesh. #V
  std::vector<std::uint32_t> face_permutation;  ///< by face: the face of the given mesh. #F
  std::vector<std::uint32_t> face_offsets;      ///< #F + 1 (see `FacesView`); empty where triangles were given
  std::vector<std::uint32_t> corners;           ///< of each face in the order given, by their new ids

  /// The mesh. Lives as long as this.
  [[nodiscard]] MeshView view() const;
};

/// Computes the index of `mesh`, and takes over its order: vertices as in the index, faces by their first vertex there.
/// The same for any number of threads.
///
/// mesh    any polygonal mesh (see `validate`); borrowed for the call.
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}, the second also beyond 2^32 - 1 faces. O(#V log #V +
/// #E + #corners).
[[nodiscard]] ReorderedMesh reorder(const MeshView& mesh, const BuildOptions& options = {});

}  // namespace meshhood
