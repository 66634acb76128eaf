// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/fingerprint.h"
#include "meshhood/level.h"
#include "meshhood/mesh.h"
#include "meshhood/progress.h"

namespace meshhood {

/// How an index is built. The index does not depend on it.
struct BuildOptions {
  /// The calling thread included; 0: as many as the processor has; at most `kMaxThreads`. With 1, none is started.
  /// Fewer do where the system gives no more.
  unsigned threads = 1;

  /// Called between the parts of each step. The longest is a pass over the vertices and edges: linear in the mesh.
  Progress progress = {};
};

/// Memory of an index by part, in bytes; of a mapped one, in the file.
struct IndexBytes {
  std::size_t positions = 0;    ///< of the vertices
  std::size_t permutation = 0;  ///< from the caller's numbering to its own, and back
  std::size_t graph = 0;        ///< the edges of the mesh
  std::size_t tree = 0;         ///< leaves, bounding spheres and columns

  [[nodiscard]] std::size_t total() const { return positions + permutation + graph + tree; }
};

struct IndexView;

/// What exact neighborhoods are searched with: the mesh in an order in which near vertices lie close together, cut into
/// connected leaves of up to 32 vertices, and a tree of bounding spheres over them. Immutable: any number of threads
/// may query it, each with its own `Searcher`. It does not refer to the mesh: `build` and `load` copy what they need,
/// and what `map` gives lies in the bytes that were mapped.
class Index {
 public:
  Index(Index&&) noexcept;
  Index& operator=(Index&&) noexcept;
  ~Index();

  /// #V.
  [[nodiscard]] std::size_t vertex_count() const;

  [[nodiscard]] IndexBytes bytes() const;

  /// The leaves, and the levels of the tree above them up to a single node.
  [[nodiscard]] std::vector<LevelSummary> levels() const;

  /// The positions in index order, #V by 3. Lives as long as the index.
  [[nodiscard]] PositionsView positions() const;

  /// The vertices in index order. #V; lives as long as the index. Empty where that is the order of the mesh (see
  /// `reorder`).
  [[nodiscard]] std::span<const VertexId> permutation() const;

  /// Verifies the index against the mesh it was built from and returns what does not hold, one line each that names
  /// leaf or node, at most sixteen. Empty means that all hold:
  ///  - leaves hold each vertex once, and the numberings agree;
  ///  - positions and edges are those of the mesh, and leaves marked connected are;
  ///  - each sphere encloses its vertices;
  ///  - from outside a column, tried from a number of vertices, no vertex is a local minimum of the distance.
  ///
  /// Throws Error{InvalidMesh, TooLarge} where `mesh` is no mesh. O((#V + #E) log #V).
  [[nodiscard]] std::vector<std::string> check(const MeshView& mesh) const;
  [[nodiscard]] std::vector<std::string> check(const GraphView& graph) const;

 private:
  friend struct IndexAccess;

  explicit Index(std::unique_ptr<const IndexView> storage);
  std::unique_ptr<const IndexView> view_;
};

/// Computes the index. The same mesh gives the same index, whatever the number of threads.
///
/// mesh    any polygonal mesh (see `validate`); borrowed for the call.
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}; the second also beyond 2^27 leaves, which have 16
/// vertices and more but for those around a vertex of very many neighbours. O(#V log #V + #E).
[[nodiscard]] Index build(const MeshView& mesh, const BuildOptions& options = {});
[[nodiscard]] Index build(const GraphView& graph, const BuildOptions& options = {});

/// The vertices and the graph of the mesh that `index` was built from, in the caller's order: what `ReferenceSearcher`,
/// `paper::build`, `ball` and `mean_edge_length` want to know, for whoever has kept the index and not the mesh.
/// O(#V + #E log(valence)).
[[nodiscard]] GraphData extract_graph(const Index& index);

/// The fingerprint of the mesh that the index was built from. O(#V + #E log(valence)); needs as much memory as
/// `extract_graph(index)`.
[[nodiscard]] Fingerprint fingerprint(const Index& index);

}  // namespace meshhood
