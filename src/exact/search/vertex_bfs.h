// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/reference.h"
#include "meshhood/searcher.h"

#include "base/reference_access.h"
#include "exact/layout.h"

namespace meshhood {

/// Whether leaves have many links of few edges, as around hubs and in random graphs. A step from leaf to leaf then
/// reaches few vertices, and breadth-first search over vertices is faster at every radius.
[[nodiscard]] bool is_unlike_a_surface(const IndexView& index);

/// Whether most vertices are numbered like the one before: their neighbors are those of that vertex, one further each.
/// So are grids and other meshes that a program has numbered row by row. A processor predicts every step of a
/// breadth-first search there, which then takes a third of the time for each vertex.
[[nodiscard]] bool is_numbered_by_rows(const AdjacencyView& graph);

/// Breadth-first search over vertices: the reference search, on a copy of the graph in the caller's order. It answers
/// - every ball, if the graph is unlike a surface, has no edges, or has no minimum regions;
/// - small balls, if the mesh is small, so that the copy stays in the cache. A ball is small if this search takes less
///   time than one over leaves. Whether it is, is remembered for each leaf, from answers to queries of its vertices.
///
/// All searchers of an index share the copy. The first that needs it makes it; for small balls, only once there were so
/// many that it pays.
class VertexBfs {
 public:
  /// How fast this search is, compared with those over leaves.
  struct Speed {
    std::uint32_t vertices_per_leaf;  // that take as long as a visit of a leaf
    double mean_leaf_radii;           // the radius of a small ball, as long as nothing is known of its place
    std::uint32_t vertices;           // that a small ball may have anywhere
  };

  // All chosen.
  static constexpr Speed kByRows{.vertices_per_leaf = 16, .mean_leaf_radii = 1.8, .vertices = 200};
  static constexpr Speed kInAnyOrder{.vertices_per_leaf = 5, .mean_leaf_radii = 0.4, .vertices = 16};
  static constexpr std::size_t kFewest = 4;             // vertices that take as long as beginning another search
  static constexpr std::size_t kMostVertices = 2000;    // of a small ball
  static constexpr std::size_t kVerticesToTheStop = 4;  // for each vertex that a small ball may have
  static constexpr std::size_t kSmallMesh = 65'536;     // vertices at most
  static constexpr std::size_t kVerticesPerBall = 16;   // of the mesh, for each small ball before the copy is made

  explicit VertexBfs(const IndexView& index);

  /// Whether it answers every ball.
  [[nodiscard]] bool answers_all() const { return answers_all_; }

  /// The neighborhood by the caller's ids, `v` first; valid until the next call. Nothing if a search over leaves should
  /// answer: the ball is probably large, or has turned out to be. Throws Error{VertexOutOfRange, InvalidRadius}.
  [[nodiscard]] std::span<const VertexId> find(VertexId v, double radius) {
    if (answers_all_) return find_all(v, radius);
    if (!(radius <= largest_radius_)) return {};
    return find_small(v, radius);
  }

  /// The same for any ball.
  [[nodiscard]] std::span<const VertexId> find_all(VertexId v, double radius) {
    prepare(v, radius);
    return ReferenceAccess::search(*searcher_, v, squared_radius_);
  }

  /// Whether there is a copy of the graph, and its vertices are numbered by rows. Then this search is no slower than a
  /// breadth-first search over leaves.
  [[nodiscard]] bool is_by_rows() const { return learns() && speed_.vertices_per_leaf == kByRows.vertices_per_leaf; }

  /// The distances of `ids`, which `find` has returned, from `v`.
  void measure(VertexId v, std::span<const VertexId> ids, std::vector<double>& out) const;

  /// `ids` as ranges in index order, ascending; valid until the next call.
  [[nodiscard]] std::span<const VertexRange> ranges_of(std::span<const VertexId> ids);

  /// After a search over leaves that has found `size` vertices in `leaf_visits` visits of leaves.
  void record(VertexId v, double radius, std::size_t size, std::size_t leaf_visits);

  /// Whether `record` has an effect.
  [[nodiscard]] bool learns() const { return !places_.empty(); }

  /// Whether a ball around a vertex of `home` is probably not small.
  [[nodiscard]] bool expects_many(LeafId home, double radius) const {
    return learns() && radius > places_[home].largest_radius;
  }

  /// From now on, answers every ball, or none.
  void answer_all();
  void answer_none();

 private:
  /// What is known of the balls around the vertices of a leaf.
  struct Place {
    double largest_radius;        // of the small ones
    std::uint32_t most_vertices;  // of one of about this radius
  };

  void prepare(VertexId v, double radius) {
    if (!searcher_) make_searcher();
    if (v >= index_->vertex_count() || radius != radius_) keep(v, radius);
  }

  void keep(VertexId v, double radius);
  [[nodiscard]] std::span<const VertexId> find_small(VertexId v, double radius);
  [[nodiscard]] bool is_small(const Place& place, double radius, std::size_t size) const;
  [[nodiscard]] bool make_places();
  void make_searcher();
  [[nodiscard]] double radius_of(double mean_leaf_radii) const;
  [[nodiscard]] Place& place_of(VertexId v) { return places_[leaf_of(index_->slot[v])]; }

  const IndexView* index_;
  bool answers_all_ = false;
  double largest_radius_ = -1;    // of the small balls of all places
  std::size_t balls_before_ = 0;  // that searches over leaves answer before the copy is made
  Speed speed_ = kByRows;
  std::vector<Place> places_;  // by leaf; empty before the copy is made
  std::optional<ReferenceSearcher> searcher_;
  // Kept from one search to the next, because most have the radius of the one before.
  double radius_ = 0;
  double squared_radius_ = 0;
  std::vector<VertexId> in_index_order_;
  std::vector<VertexRange> ranges_;
};

}  // namespace meshhood
