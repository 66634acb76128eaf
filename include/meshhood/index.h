// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/fingerprint.h"
#include "meshhood/level.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/run.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

class KeptGraph;
struct IndexView;

/// The index of exact neighborhoods: the mesh in an order in which near vertices are close in memory, cut into
/// connected leaves of up to 32 vertices, and a tree of bounding spheres over the leaves.
///
/// Any number of threads may query it, each with its own `Searcher`; only `refit_in_place` changes it. It does not
/// refer to the mesh: `build` and `load` copy what they need; the result of `map` refers to the mapped bytes.
///
/// An index that has been moved from can be assigned and destroyed. All else throws Error{InvalidOption}.
class Index {
 public:
  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Returns the memory of all arrays but the faces. Takes O(1).
  [[nodiscard]] IndexBytes bytes() const;

  /// Returns statistics of the leaves, and of the levels of nodes above them. Takes O(#levels).
  [[nodiscard]] std::vector<LevelSummary> levels() const;

  /// Returns the positions in index order, #V by 3. They are valid as long as the index, or until a refit in place.
  [[nodiscard]] PositionsView positions() const&;
  [[nodiscard]] PositionsView positions() const&& = delete;

  /// Returns the caller's id of each vertex in index order, #V: the order in which the index stores the vertices and
  /// answers list them. It is empty if the two orders are the same (see `reorder`), and valid as long as the index.
  [[nodiscard]] std::span<const VertexId> permutation() const&;
  [[nodiscard]] std::span<const VertexId> permutation() const&& = delete;

  /// Returns the first vertex of each leaf in index order, and #V: #leaves + 1. Leaves may be empty. Valid as long as
  /// the index.
  [[nodiscard]] std::span<const VertexId> leaf_starts() const&;
  [[nodiscard]] std::span<const VertexId> leaf_starts() const&& = delete;

  /// Returns the faces of the mesh, if the index was loaded or mapped from a file that was saved with them (see
  /// `SaveOptions`), or is a refit of such an index. Corners and offsets have 32 bits. They are valid as long as the
  /// index. Takes O(1).
  [[nodiscard]] std::optional<FacesView> faces() const&;
  [[nodiscard]] std::optional<FacesView> faces() const&& = delete;

  /// Moves the vertices of this index, which then equals the result of `refit` with the same arguments (see refit.h).
  /// Without `changed`, positions and bounds are made beside the old ones, which are then freed; with it, they are
  /// changed in place, unless refit.h says otherwise.
  ///
  /// No thread may use the index, or its searchers, surfaces or masked indices, meanwhile. Afterwards a searcher throws
  /// Error{InvalidOption} until `rebind` makes it one of the new state, and a `Surface` until its `refit_in_place`. A
  /// masked index (see masks.h) throws, too, and is to be made again.
  ///
  /// Throws as `refit`; the index is then as it was.
  void refit_in_place(const PositionsView& positions, const Run& run = {});
  void refit_in_place(const PositionsView& positions, const IndicesView& changed, const Run& run = {});

  /// Verifies the index against the mesh it was built from. Returns one line per violation, naming the leaf or node, at
  /// most sixteen. An empty result means:
  ///  - the leaves contain each vertex once, and the numberings agree;
  ///  - positions and edges are those of the mesh, and leaves marked connected are connected;
  ///  - the links between nodes are those of the mesh, and every node above the leaves is connected by them;
  ///  - each sphere encloses its vertices.
  ///
  /// Throws Error{InvalidMesh, TooLarge} if `mesh` is invalid, and Error{InvalidOption} for an index with masks or of
  /// paths along a surface. Takes O((#V + #E) log #V).
  [[nodiscard]] std::vector<std::string> check(const MeshView& mesh) const;
  [[nodiscard]] std::vector<std::string> check(const GraphView& graph) const;

 private:
  friend struct IndexAccess;

  explicit Index(std::shared_ptr<IndexView> view);

  /// Throws if the index has been moved from, or is masked and its index has been refitted in place.
  [[nodiscard]] IndexView& view() const;

  detail::Owner<IndexView> view_;     // searchers share it
  std::shared_ptr<KeptGraph> graph_;  // and this
};

/// Builds the index. The same mesh gives the same index for any number of threads. Progress is reported between the
/// parts of each step, of which the longest is a pass over the vertices and edges.
///
/// mesh    any polygonal mesh (see `validate`); borrowed for the call.
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}. TooLarge also beyond 2^27 leaves; a leaf has at least
/// 16 vertices, except around vertices with very many neighbors. Takes O(#V log #V + #E).
[[nodiscard]] Index build(const MeshView& mesh, const Run& run = {});
[[nodiscard]] Index build(const GraphView& graph, const Run& run = {});

/// Builds the index from arrays, which are borrowed for the call.
///
/// positions  float or double in contiguous memory: 3 #V numbers, vertex after vertex, or #V points (see `RowOfThree`);
///            or a `PositionsView`, for other layouts.
/// faces      integers of 16 to 64 bits in contiguous memory: 3 #F corners of triangles, or #F triangles, each a row of
///            three; or a `FacesView`, for polygons and other layouts.
template <class Positions, class Faces>
  requires(!std::same_as<Faces, Run>)
[[nodiscard]] Index build(const Positions& positions, const Faces& faces, const Run& run = {}) {
  constexpr bool kArePositions = std::constructible_from<PositionsView, const Positions&>;
  constexpr bool kAreTriangles = requires { FacesView::triangles(faces); };
  constexpr bool kAreFaces = kAreTriangles || std::same_as<Faces, FacesView>;
  static_assert(kArePositions,
                "positions: expected float or double in contiguous memory, 3 #V numbers or #V points of three; "
                "PositionsView and meshhood/eigen.h read other layouts");
  static_assert(kAreFaces,
                "faces: expected integers of 16 to 64 bits in contiguous memory, 3 #F corners or #F triangles of "
                "three; FacesView and meshhood/eigen.h read polygons and other layouts");
  if constexpr (kArePositions && kAreTriangles) {
    return build(MeshView{positions, FacesView::triangles(faces)}, run);
  } else if constexpr (kArePositions && kAreFaces) {
    return build(MeshView{positions, faces}, run);
  }
}

/// Returns the positions and the graph of the mesh that `index` was built from, in the caller's order: the input of
/// `ReferenceSearcher` and `paper::build` for callers that kept only the index. Takes O(#V + #E log(valence)).
[[nodiscard]] GraphData extract_graph(const Index& index);

/// Returns the mean length of the edges of the mesh that the index was built from. Costs as much as `extract_graph`.
[[nodiscard]] double mean_edge_length(const Index& index);

/// Returns the fingerprint of the mesh that the index was built from. Takes O(#V + #E log(valence)), and as much memory
/// as `extract_graph`.
[[nodiscard]] Fingerprint fingerprint(const Index& index);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
