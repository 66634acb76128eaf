// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/owner.h"
#include "meshhood/start.h"

namespace meshhood {

/// One step of a brush stroke: a start and a radius.
struct Dab {
  Start start;
  double radius;
};

/// Finds regions by an `Index`. The *region* of a start and a radius is the set of vertices that are connected to a
/// seed by a path of edges whose vertices, both ends included, all lie within the radius of the center and are not
/// walls. Ignored vertices are left out. If the start is a vertex, the region is the neighborhood (see
/// `Searcher`).
///
/// radius  >= 0 or infinite, in the unit of the positions; a vertex at exactly `radius` is inside.
///
/// An answer depends on the index, the start and the radius alone. Its ids are in index order: ascending
/// places of the permutation of the index. If the mesh was renumbered by `reorder`, they ascend.
///
/// The cost grows with the number of leaves of the result; for a vertex, `region`, `count` and
/// `nested` cost as much as queries of a `Searcher`. Nothing is allocated once the buffers have grown.
///
/// Use one object per thread: it owns scratch memory, about 64 bytes per leaf, and that of a `Searcher` after the first
/// such query for a vertex. It shares the memory of the index, which may be moved, refitted or
/// destroyed meanwhile: answers are those of the index as it was.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption}, naming the seed or the coordinate; arguments
/// are then unchanged.
class RegionSearcher {
 public:
  explicit RegionSearcher(const Index& index);
  explicit RegionSearcher(const Index&&) = delete;

  /// Goes on with `index`: the answers are then those of a new searcher. After `refit_in_place` of the same index, it
  /// keeps its scratch memory and takes O(1).
  void rebind(const Index& index);
  void rebind(const Index&&) = delete;

  /// Returns the ids as a new list. For many queries, the calls below use the memory of the last answer again.
  [[nodiscard]] std::vector<VertexId> region(const Start& start, double radius) {
    std::vector<VertexId> out;
    region(start, radius, out);
    return out;
  }

  /// Returns whether a seed lies in the ball, as a vertex that is the start always does. If none does, the answer is
  /// empty: the center is too far from the mesh.
  ///
  /// out     replaced, its capacity reused: ids in index order, without duplicates.
  bool region(const Start& start, double radius, std::vector<VertexId>& out);

  /// Also returns the distance of each vertex from the center, in the order of the ids. See `distance`.
  bool region(const Start& start, double radius, std::vector<VertexId>& out, std::vector<double>& distances);

  /// The number of vertices of the region.
  [[nodiscard]] std::size_t count(const Start& start, double radius);

  /// The union of the regions of `dabs`, such as those of a brush stroke. Returns whether each ball has a seed.
  ///
  /// out     replaced: ids in index order, without duplicates.
  /// An error names the dab. The cost is that of the single regions together.
  bool stroke(std::span<const Dab> dabs, std::vector<VertexId>& out);

  /// The regions of one start for several radii, each vertex once. Around a vertex, about as fast as
  /// the queries of a `Searcher`; else about as fast as the region of the largest radius. Returns whether a seed lies
  /// in the largest ball; true without radii.
  ///
  /// radii   strictly ascending.
  /// out     replaced: the region of the largest radius, ring by ring. Ring `i` has the vertices of the region of
  ///         `radii[i]` that the region of `radii[i - 1]` does not have. A near vertex may belong to a late ring if
  ///         only the wider ball connects it. Each ring is in index order.
  /// counts  replaced, one for each radius: the region of `radii[i]` is the first `counts[i]` ids of `out`.
  bool nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& out,
              std::vector<std::size_t>& counts);

  /// Whether the region has vertex `w`. Costs at most as much as the region, and less if the search reaches `w` early.
  [[nodiscard]] bool contains(const Start& start, VertexId w, double radius);

  /// The smallest radius whose region has vertex `w`; infinite if there is none. It is the minimum, over all paths from
  /// a seed to `w`, of the largest distance between a vertex of the path and the center (a bottleneck shortest path).
  ///
  /// Costs about as much as the region of the result.
  [[nodiscard]] double connecting_radius(const Start& start, VertexId w);

  /// The `k` nearest connected vertices: the first `k`, ordered by connecting radius, then by distance from the center,
  /// then by id. So the answer for a smaller `k` is the beginning of that for a larger one. Fewer than `k` if no more
  /// are connected.
  ///
  /// out     replaced: ids in that order.
  /// radii   replaced: the connecting radius of each vertex.
  /// O(k log k) on most surfaces.
  void nearest_connected(const Start& start, std::size_t k, std::vector<VertexId>& out, std::vector<double>& radii);

 private:
  friend struct RegionAccess;

  struct State;
  detail::Owner<State> state_;
};

}  // namespace meshhood
