// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/metric.h"
#include "meshhood/owner.h"
#include "meshhood/start.h"
#include "meshhood/vertex.h"

/// Queries about the neighborhood of one vertex or point: the exact searcher, what all searchers have in common, and
/// the folding of answers. Batches of many vertices are in batch.h.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

struct SingleQueries;

/// The vertices `begin .. end - 1` in the order of a searcher; its `permutation()` maps them to the caller's ids.
struct VertexRange {
  VertexId begin;
  VertexId end;

  [[nodiscard]] std::size_t size() const { return std::size_t{end} - begin; }

  friend bool operator==(const VertexRange&, const VertexRange&) = default;
};

/// A type that answers queries about the neighborhood of a vertex `v` within `radius`. `Searcher`, `paper::Searcher`,
/// `ReferenceSearcher` and `BallSearcher` satisfy it; they differ in what belongs to the neighborhood.
///
/// - `v` is in [0, `vertex_count()`). `radius` is >= 0 or infinite, in the unit of the positions. A vertex at exactly
///   `radius` is inside.
/// - `neighborhood` fills `ids`, and `distances` in the same order. Each vertex is listed once, `v` included unless a
///   mask leaves it out (see masks.h).
/// - `count` returns the number of vertices.
/// - `ranges` returns the neighborhood as disjoint, nonempty ranges of the searcher's order, valid until the next call.
/// - `permutation()` gives the caller's id of each vertex in that order; it is empty if the two orders are the same.
/// - An answer depends on the index or mesh, the vertex and the radius alone, and so does the order of its ids and
///   ranges. Earlier queries, threads and the processor have no effect.
///
/// A searcher owns scratch memory: use one object per thread.
template <class S>
concept NeighborhoodSearcher = requires(S& searcher, const S& constant, VertexId v, double radius,
                                        std::vector<VertexId>& ids, std::vector<double>& distances) {
  { constant.vertex_count() } -> std::same_as<std::size_t>;
  { constant.permutation() } -> std::same_as<std::span<const VertexId>>;
  { searcher.neighborhood(v, radius) } -> std::same_as<std::vector<VertexId>>;
  { searcher.neighborhood(v, radius, ids) } -> std::same_as<void>;
  { searcher.neighborhood(v, radius, ids, distances) } -> std::same_as<void>;
  { searcher.count(v, radius) } -> std::same_as<std::size_t>;
  { searcher.ranges(v, radius) } -> std::same_as<std::span<const VertexRange>>;
};

/// One step of a brush stroke: a start and a radius.
struct Dab {
  Start start;
  Radius radius;
};

/// Answers questions about one vertex, or one point, at a time by an `Index`. A *start* is a vertex, or a point in
/// space with the vertices from which the search spreads, its seeds (see `Start`). The *neighborhood* of a start and a
/// radius depends on the metric:
///
/// - `Metric::Straight`: the vertices that are connected to a seed by a path of edges whose vertices, both ends
///   included, all lie within the radius of the center. Around a vertex it is the component with the vertex of the
///   graph induced by the vertices in the ball: the same set as that of `ReferenceSearcher`, on every processor.
/// - `Metric::Path`: the vertices whose *path distance* from the vertex is at most the radius: the least length of a
///   path of edges. The length of an edge is the distance of its ends (see `distance`); that of a path is the sum of
///   those of its edges, added in double in the order of the path. The rounded sum never decreases if a summand grows,
///   so the search finds the least sum to the last bit, as does the algorithm of Dijkstra (1959). An index of
///   `surface_paths` also has lines over pairs of triangles. From a point, a path begins with the straight line to a
///   seed: with the corners of its face as seeds, such a line lies in the face.
/// - `Metric::Rings`: the vertices that at most `radius` edges, rounded down, separate from the vertex.
/// - `Metric::Space`: the vertices within the radius of the center, connected or not. Seeds do not count.
///
/// Walls of a masked index are not in its mesh; ignored vertices are passed, but belong to no answer.
///
/// start   a vertex in [0, #V); or a point, but not by rings.
/// radius  >= 0 or infinite, in the unit of the positions, or a number of edges; a vertex at exactly `radius` is
/// inside.
///
/// An answer depends on the index, the start and the radius alone. Its ids have no duplicates. Those of paths ascend by
/// path distance, those at the same distance are in index order; all others are in index order: ascending places of the
/// permutation of the index. If the mesh was renumbered by `reorder`, they ascend.
///
/// The cost of a ball around a vertex grows with the number of leaves that its surface intersects, not with the size of
/// the result or the mesh; on folded surfaces, and from a point, with the number of leaves of the result. Paths take
/// O(n log n) for a result of n vertices, and the first search of an index O(#V + #E): the index keeps the lengths of
/// all edges for all searchers (76 bytes a vertex with six edges). Rings take O(n), space a time that grows with the
/// leaves at the surface of the ball. Only `nested`, `nearest_connected` and `stroke` allocate once the buffers have
/// grown.
///
/// Use one object per thread: it owns scratch memory, 23 to 30 bytes per leaf for balls around vertices, 64 for all
/// else of the straight metric, up to 250 more for `connecting_radius` and `nearest_connected`; 8 bytes a vertex for
/// paths. Each part is made when it is first needed. It shares the memory of the index, which may be moved or destroyed
/// meanwhile: answers are those of the index as it was. After `refit_in_place`, each query throws Error{InvalidOption}
/// until `rebind`; so do those of one that has been moved from, which can be assigned, destroyed and bound again.
///
/// On a graph unlike a surface (with a vertex that has very many neighbors, or with random edges), a ball takes the
/// steps of `ReferenceSearcher` and up to four times as long. Each searcher then owns 20 bytes per vertex more (36 for
/// double). All of them share a copy of the graph, which the index keeps: 4 bytes per vertex and 4 for each of its
/// neighbors, which `Index::bytes` does not count. The query that makes it takes O(#V + #E).
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption}, naming the seed, the coordinate, the dab or `k`;
/// arguments are then unchanged. A point as a start by rings is an InvalidOption, because a point has no edges; so is
/// `nearest_connected` in space, where nothing is connected.
class Searcher {
 public:
  /// Throws Error{InvalidOption} if the index has been moved from, or is masked and its mesh was refitted in place.
  explicit Searcher(const Index& index, Metric metric = Metric::Straight);
  explicit Searcher(const Index&&, Metric = Metric::Straight) = delete;

  /// Goes on with `index`: the answers are then those of a new searcher. After `refit_in_place` of the same index, it
  /// keeps its scratch memory and takes O(1). If all vertices have moved, the next search by paths takes O(#V + #E); on
  /// a graph unlike a surface, the next search always does. Throws as the constructor.
  void rebind(const Index& index);
  void rebind(const Index&&) = delete;

  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Returns the permutation of the index. It is valid as long as the searcher, or until `rebind`.
  [[nodiscard]] std::span<const VertexId> permutation() const&;
  [[nodiscard]] std::span<const VertexId> permutation() const&& = delete;

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> neighborhood(const Start& start, Radius radius) {
    std::vector<VertexId> out;
    neighborhood(start, radius, out);
    return out;
  }

  /// out     replaced, its capacity reused. Empty if no seed lies in the ball (see `has_seed`), or if all are walls.
  void neighborhood(const Start& start, Radius radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from the center (see `distance`), its path distance or its number of
  /// edges, in the order of the ids.
  void neighborhood(const Start& start, Radius radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// Returns the neighborhood as ranges of the index order, without copying ids. They ascend, with gaps between them,
  /// are not empty, and are valid until the next call. For a vertex, `visit` and `reduce` loop over them.
  [[nodiscard]] std::span<const VertexRange> ranges(const Start& start, Radius radius) &;

  /// Returns the number of vertices of the neighborhood.
  [[nodiscard]] std::size_t count(const Start& start, Radius radius);

  /// Returns whether a seed lies in the ball, as a vertex that is the start always does; in space, which needs none,
  /// true. If none does, the center is too far from the mesh, and the neighborhood is empty. Takes O(#seeds).
  [[nodiscard]] bool has_seed(const Start& start, Radius radius) const;

  /// Finds the neighborhoods of one start for several radii, each vertex once. For balls around a vertex, this is about
  /// as fast as the neighborhoods one by one; else as that of the largest radius.
  ///
  /// radii   strictly ascending.
  /// out     replaced: the neighborhood of the largest radius, ring by ring. Ring `i` has the vertices of the
  ///         neighborhood of `radii[i]` that that of `radii[i - 1]` does not have. A near vertex may belong to a late
  ///         ring if only the wider ball connects it. Each ring is in index order.
  /// counts  replaced, one for each radius: the neighborhood of `radii[i]` is the first `counts[i]` ids of `out`.
  void nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& out,
              std::vector<std::size_t>& counts);

  /// Returns whether the neighborhood has vertex `w`. Costs at most as much as finding it, and less if the search
  /// reaches `w` early.
  [[nodiscard]] bool contains(const Start& start, Vertex w, Radius radius);

  /// Returns the smallest radius whose neighborhood has vertex `w`; infinite if there is none. Straight, it is the
  /// minimum, over all paths from a seed to `w`, of the largest distance between a vertex of the path and the center (a
  /// bottleneck shortest path); else the path distance, the number of edges, or the distance in space.
  ///
  /// Costs about as much as the neighborhood of the result.
  [[nodiscard]] double connecting_radius(const Start& start, Vertex w);

  /// Finds the `k` >= 1 nearest connected vertices: the first, ordered by connecting radius; straight, then by distance
  /// from the center, then by id; else then by place in index order. So the answer for a smaller `k` is the beginning
  /// of that for a larger one. There are fewer than `k` if no more are connected.
  ///
  /// out     replaced: ids in that order.
  /// radii   replaced: the connecting radius of each vertex.
  /// Takes O(k log k) on most surfaces.
  void nearest_connected(const Start& start, std::size_t k, std::vector<VertexId>& out, std::vector<double>& radii);

  /// Finds the union of the neighborhoods of `dabs`, such as those of a brush stroke.
  ///
  /// out     replaced: ids in index order.
  /// The cost is that of the single neighborhoods together.
  void stroke(std::span<const Dab> dabs, std::vector<VertexId>& out);

 private:
  friend struct SearcherAccess;

  Metric metric_;  // also of one that has been moved from, which can be bound again
  detail::Owner<SingleQueries> queries_;
};

/// Calls `on_run(VertexRange)` for each range of the neighborhood, in the order of `ranges`: with a `Searcher`
/// ascending. No id is copied. If `on_run` returns bool, false stops the visit. Returns whether it visited every range.
///
/// The whole neighborhood is found before the first call: an early stop saves the work of `on_run`, not the search.
/// `on_run` must not use `searcher`.
///
/// Throws as `searcher.ranges`; an exception from `on_run` is passed on.
template <NeighborhoodSearcher S, class F>
bool visit(S& searcher, Vertex v, double radius, F&& on_run) {
  for (const VertexRange run : searcher.ranges(v, radius)) {
    if constexpr (std::is_same_v<std::invoke_result_t<F&, VertexRange>, bool>) {
      if (!std::invoke(on_run, run)) return false;
    } else {
      std::invoke(on_run, run);
    }
  }
  return true;
}

/// Folds the neighborhood: starts with `init` and replaces it by `f(value, VertexRange)` for each range of `visit`. The
/// same query gives the same ranges in order, so a floating-point sum has the same bits. Throws as `visit`.
template <NeighborhoodSearcher S, class T, class F>
[[nodiscard]] T reduce(S& searcher, Vertex v, double radius, T init, F&& f) {
  visit(searcher, v, radius, [&](VertexRange run) { init = std::invoke(f, std::move(init), run); });
  return init;
}

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
