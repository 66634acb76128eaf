// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/searcher.h"

#include "base/reference_access.h"
#include "exact/layout.h"

namespace meshhood {

/// Whether leaves have many links of few edges, as around hubs and in random graphs. A step from leaf to leaf then
/// reaches few vertices, and breadth-first search over vertices is faster at every radius.
[[nodiscard]] bool is_unlike_a_surface(const IndexView& index);

/// Breadth-first search over vertices: the reference search, on a copy of the graph in the caller's order. It answers
/// - every ball, if the graph is unlike a surface or has no minimum regions;
/// - small balls, those of few vertices, if the mesh is small, so that the copy stays in the cache. Whether a ball is
///   small is guessed from its radius, and the guess follows the answers.
///
/// All searchers of an index share the copy. The first that needs it makes it; for small balls, only once there were so
/// many that it pays.
class VertexBfs {
 public:
  // All chosen.
  static constexpr std::size_t kSmallMesh = 65'536;    // vertices at most
  static constexpr std::size_t kFewVertices = 200;     // of a small ball, at most
  static constexpr std::size_t kMostVertices = 800;    // of a ball that was taken for small, before the search stops
  static constexpr std::size_t kVerticesPerBall = 16;  // of the mesh, for each small ball before the copy is made

  explicit VertexBfs(const IndexView& index);

  /// Whether it answers every ball.
  [[nodiscard]] bool answers_all() const { return most_ == kAll; }

  /// The neighborhood by the caller's ids, `v` first; valid until the next call. Nothing if a search over leaves should
  /// answer: the ball is probably large, or has turned out to be. Throws Error{VertexOutOfRange, InvalidRadius}.
  [[nodiscard]] std::span<const VertexId> find(VertexId v, double radius) {
    if (!(radius <= largest_radius_)) return {};
    if (!searcher_ && !make_searcher()) return {};
    const std::span<const VertexId> found = ReferenceAccess::search(*searcher_, v, radius, most_);
    const bool is_small = found.size() <= few_ && !found.empty();
    if (!is_small) take_for_large(radius);
    return found;
  }

  /// The distances of `ids`, which `find` has returned, from `v`.
  void measure(VertexId v, std::span<const VertexId> ids, std::vector<double>& out) const;

  /// `ids` as ranges in index order, ascending; valid until the next call.
  [[nodiscard]] std::span<const VertexRange> ranges_of(std::span<const VertexId> ids);

  /// After a search over leaves that has found `size` vertices.
  void record(double radius, std::size_t size) {
    if (learns_ && size <= few_ && radius > largest_radius_) largest_radius_ = radius;
  }

  /// Whether `record` has an effect.
  [[nodiscard]] bool learns() const { return learns_; }

  /// Whether a ball of a small mesh is probably large.
  [[nodiscard]] bool expects_many(double radius) const { return learns_ && radius > largest_radius_; }

  /// From now on, answers every ball, or none.
  void answer_all();
  void answer_none();

 private:
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] bool make_searcher();
  void take_for_large(double radius);

  const IndexView* index_;
  double largest_radius_ = -1;    // of the balls that are taken for small
  std::size_t few_ = 0;           // vertices of a small ball
  std::size_t most_ = 0;          // vertices before the search stops
  bool learns_ = false;           // whether `largest_radius_` changes
  std::size_t balls_before_ = 0;  // that searches over leaves answer before the copy is made
  std::optional<ReferenceSearcher> searcher_;
  std::vector<VertexId> in_index_order_;
  std::vector<VertexRange> ranges_;
};

}  // namespace meshhood
