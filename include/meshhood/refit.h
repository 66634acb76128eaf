// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"

/// Updates indexes of meshes whose vertices move, while their edges stay as they are: animation, simulation, sculpting.
///
///     auto index = meshhood::build(mesh);
///     ...
///     index.refit_in_place(positions, changed);   // these vertices have moved; without `changed`, all may have
///     searcher.rebind(index);                     // each searcher that goes on
///
/// Or, if the state before is still needed:
///
///     const auto moved = meshhood::refit(index, positions, changed);
///
/// The order of the vertices, the leaves and the edges stay as they are and are shared with the index that was given.
/// In place, the lengths of edges that paths need are renewed where vertices have moved. Positions and bounding spheres
/// are computed again from the leaves up. Answers are exact, whatever the positions. Queries take longer once vertices
/// of a leaf have moved far apart; `quality` measures this.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Returns the index of the mesh after its vertices have moved.
///
/// index      stays as it is, with its searchers, which answer by the old positions.
/// positions  #V by 3, in the order and the unit in which the mesh of `index` was given; for an index that `reorder`
///            made, in index order. Float or double. Borrowed for the call.
///
/// With the positions of `index`, the result equals it byte for byte. The result owns its positions and its tree. It
/// shares the rest of the memory with `index`; if that was loaded or mapped, it keeps the bytes of the file alive.
///
/// Throws Error{InvalidMesh, InvalidOption, Cancelled}: InvalidMesh if there are not #V positions, or if `validate`
/// rejects one, naming the vertex. Takes O(#V), a fraction of the time of `build`.
[[nodiscard]] Index refit(const Index& index, const PositionsView& positions, const Run& run = {});

/// Does the same if only the vertices `changed` have moved. Positions of others are not read.
///
/// positions  as above; may be float for an index in double; the reverse is Error{InvalidMesh}.
/// changed    ids of vertices, in any order; duplicates are allowed. Borrowed for the call; read once.
///
/// Copies everything that depends on the positions: 14 bytes a vertex in float, 26 in double. `Index::refit_in_place`
/// copies this only in its first call for an index that was loaded or mapped.
///
/// If a vertex leaves the cube in which the tree is stored, all bounds are computed again, as above.
///
/// Throws also Error{VertexOutOfRange}, naming the row of `changed`. Besides the copy, it takes O(#changed log #V), for
/// the leaves of these vertices and the nodes above, and a sum over all leaves.
[[nodiscard]] Index refit(const Index& index, const PositionsView& positions, const IndicesView& changed,
                          const Run& run = {});

/// How well the leaves of an index fit the positions.
struct Quality {
  double mean_radius;     ///< of the leaves at some places of the mesh, in the unit of the positions
  double rebuilt_radius;  ///< of the leaves that `build` would make there
  double gain;            ///< the first divided by the second; 1 for a mesh without vertices
};

/// Compares the leaves with those that `build` would make of the present positions.
///
/// Most of the time of a query goes to the leaves that the surface of the ball meets, and their number grows with their
/// radius. So `gain` is roughly how many times faster queries would be after `build`. It is measured at sixteen places
/// spread over the vertices: the thousand vertices nearest to each are divided into leaves as by `build`, and for those
/// in the middle the radius of the bounding sphere of the present leaf is compared with that of the new one.
///
/// After `build`, `gain` is 0.9 to 1.1 on surfaces. At 1.5 and above, `build` again if many queries follow. On graphs
/// whose edges are long compared with a leaf, the estimate is too high. The result is deterministic. Takes O(#V), for
/// the box of the positions, and a build of 16384 vertices.
[[nodiscard]] Quality quality(const Index& index);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
