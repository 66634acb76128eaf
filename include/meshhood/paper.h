// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/level.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/run.h"
#include "meshhood/search.h"
#include "meshhood/vertex.h"

/// Implements the index and the query of *Fast neighborhood search on polygonal meshes*, sections 3.2 and 3.3.
/// `docs/paper.md` lists the deviations from the paper, with reasons.
namespace meshhood::inline v0_1::paper {
MESHHOOD_API_BEGIN

/// A cluster, by its number on its level.
using ClusterId = VertexId;

/// How the hierarchy is built (3.2, 4.1).
struct BuildOptions {
  /// The number of levels to compute, the base level (one cluster per vertex) included; >= 1. Construction ends earlier
  /// if every component of the mesh has become a single cluster; `kAllLevels` always continues until then.
  int levels = 5;

  /// The number of lowest levels to drop after all are built; >= 0. The last level is always kept.
  int discard = 2;

  /// Fusion on level `l` dissolves clusters of fewer than `fusion_growth` to the power of `l` vertices, and with any
  /// growth those with a single child; finite, >= 0. The paper has such a threshold and does not say which.
  double fusion_growth = 4.0;

  /// More than there are: of an unfinished component, each level has at most half the clusters of the one below.
  static constexpr int kAllLevels = 64;
};

/// The hierarchy of connected clusters (3.1), with the positions in the order of the clusters.
///
/// It is immutable: any number of threads may query it, each with its own `Searcher`. It does not refer to the mesh. An
/// index that has been moved from can be assigned and destroyed. All else throws Error{InvalidOption}.
class Index {
 public:
  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Returns the memory of all arrays. Takes O(#levels).
  [[nodiscard]] IndexBytes bytes() const;

  /// Returns statistics of the levels kept, lowest first; at least one.
  [[nodiscard]] std::vector<LevelSummary> levels() const;

  /// Returns the positions in index order, #V by 3. They are valid as long as the index.
  [[nodiscard]] PositionsView positions() const&;
  [[nodiscard]] PositionsView positions() const&& = delete;

  /// Returns the caller's id of each vertex in index order, #V. Every cluster of every level is a contiguous range of
  /// it. Valid as long as the index.
  [[nodiscard]] std::span<const VertexId> permutation() const&;
  [[nodiscard]] std::span<const VertexId> permutation() const&& = delete;

  /// Verifies every statement of sec. 3.1 against the mesh that the index was built from. Returns one line per
  /// violation, naming level and cluster, at most sixteen. An empty result means:
  ///  - each level partitions the vertices;
  ///  - a parent is the union of its children, and the links in both directions agree;
  ///  - each cluster is connected on the mesh, so none spans two components;
  ///  - each sphere encloses its vertices, and that of a base cluster has radius 0;
  ///  - siblings are symmetric, irreflexive and exactly the pairs that an edge of the mesh joins;
  ///  - levels shrink: only a cluster that is a whole component may have a single child;
  ///  - the averages are finite and correct.
  ///
  /// Throws Error{InvalidMesh, TooLarge} if `mesh` is invalid. Takes O((#V + #E) #levels).
  [[nodiscard]] std::vector<std::string> check(const MeshView& mesh) const;
  [[nodiscard]] std::vector<std::string> check(const GraphView& graph) const;

 private:
  friend class Searcher;
  friend struct IndexAccess;

  struct Storage;
  explicit Index(std::unique_ptr<const Storage> storage);
  detail::Owner<const Storage> storage_;
};

/// Builds the index (3.2): create, select, fusion, link, level by level, and the spheres last. The same mesh and
/// options give the same index. Uses one thread, whatever `run` says: each step visits the clusters one after the
/// other, and a decision depends on those before it, so that the result of the paper is defined by a sequential order.
/// Progress is reported between the steps of each level, of which the longest takes O((#V + #E) log #V).
///
/// mesh    any polygonal mesh (see `meshhood::validate`); borrowed for the call.
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}. Takes O(#levels (#V + #E) log #V).
[[nodiscard]] Index build(const MeshView& mesh, const BuildOptions& options = {}, const Run& run = {});
[[nodiscard]] Index build(const GraphView& graph, const BuildOptions& options = {}, const Run& run = {});

/// The parameter of a query (3.3).
struct QueryOptions {
  /// `f` of sec. 3.3; finite, > 0. The climb ends on the first level whose mean radius is at least radius / f: a larger
  /// ratio means smaller clusters, more of them, and fewer vertices outside the exact neighborhood.
  double radius_ratio = 10.0;
};

/// Throws Error{InvalidOption} unless `options` are in their ranges.
void validate(const QueryOptions& options);

/// Statistics of the last query of a `Searcher`, for the profile of sec. 4.3.
struct QueryProfile {
  int level = 0;                     ///< the level where the climb ended
  std::size_t clusters_reached = 0;  ///< clusters found by the breadth-first search: `SC` of sec. 3.3
  std::size_t vertices_tested = 0;   ///< vertices whose distance was computed
};

/// Finds the approximate neighborhoods of the paper by an `Index` (3.3): climb up, breadth-first search over siblings,
/// range search. The result contains the exact neighborhood and is contained in the ball.
///
/// v       in [0, #V).
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` is inside.
///
/// The result need not grow with the radius, because the level may change. The cost is that of the clusters touched,
/// not of the mesh. Nothing is allocated once the buffers have grown.
///
/// Use one object per thread: it owns scratch memory, about 24 bytes per cluster of the lowest level. The index
/// may be moved or destroyed meanwhile.
///
/// Throws Error{VertexOutOfRange, InvalidRadius}; arguments are then unchanged.
class Searcher {
 public:
  /// Throws Error{InvalidOption}.
  explicit Searcher(const Index& index, const QueryOptions& options = {});
  explicit Searcher(const Index&&, const QueryOptions& = {}) = delete;

  /// Sets the options of the queries that follow. Throws Error{InvalidOption}; the old options then stay.
  void set_options(const QueryOptions& options);

  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Returns the permutation of the index. It is valid as long as the searcher.
  [[nodiscard]] std::span<const VertexId> permutation() const&;
  [[nodiscard]] std::span<const VertexId> permutation() const&& = delete;

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> neighborhood(Vertex v, double radius) {
    std::vector<VertexId> out;
    neighborhood(v, radius, out);
    return out;
  }

  /// out     replaced, its capacity reused: ids without duplicates, `v` included. Their order depends on the
  ///         index, the options, the vertex and the radius alone.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from `v` (see `distance`), in the order of the ids.
  void neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// Returns the neighborhood as ranges of the index order, without copying ids: in the same order, disjoint, none
  /// empty, and valid until the next call. `visit` and `reduce` loop over them.
  [[nodiscard]] std::span<const VertexRange> ranges(Vertex v, double radius) &;

  /// Returns the number of vertices of the neighborhood.
  [[nodiscard]] std::size_t count(Vertex v, double radius);

  /// Returns statistics of the last successful query.
  [[nodiscard]] const QueryProfile& profile() const& { return profile_; }
  [[nodiscard]] const QueryProfile& profile() const&& = delete;

 private:
  friend struct SearcherAccess;  // defined by tests

  /// Vertices in index order of which all, or those within the radius, belong to the answer.
  struct Piece {
    VertexId begin;
    VertexId end;
    bool inside;

    [[nodiscard]] std::size_t size() const { return std::size_t{end} - begin; }
  };

  /// Runs the three phases for one precision of positions, and leaves the pieces of the answer in `scratch_`.
  template <class Real>
  class Query;

  template <class F>
  void run(VertexId v, double radius, F&& answer);

  /// Returns a number that marks no cluster yet.
  std::uint32_t next_query();

  struct Scratch {
    std::vector<std::uint32_t> visited;  // by cluster: the last query that saw it
    std::uint32_t query = 0;
    std::vector<ClusterId> reached;
    std::vector<ClusterId> refined;
    std::vector<Piece> pieces;
    std::vector<VertexRange> ranges;
  };

  detail::Owner<const Index::Storage> storage_;
  detail::Owner<Scratch> scratch_;
  QueryOptions options_;
  QueryProfile profile_;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1::paper
