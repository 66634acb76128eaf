// SPDX-License-Identifier: MIT
// The query of sec. 3.3 has three phases: climb up, breadth-first search, range search. In its words, `radius` is d,
// `ball_` is S, `cluster_` is C and `reached_` is SC. The answer is first a list of ranges of the index order; ids are
// copied, or vertices counted, afterwards.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "meshhood/error.h"
#include "meshhood/paper.h"

#include "base/ranges.h"
#include "paper/hierarchy.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::inline v0_1::paper {

template <class Real>
class Searcher::Query {
 public:
  Query(Searcher& searcher, const Hierarchy<Real>& hierarchy, VertexId v, double radius)
      : searcher_(searcher),
        scratch_(*searcher.scratch_),
        hierarchy_(hierarchy),
        cluster_(static_cast<ClusterId>(hierarchy.lowest_cluster[v])),
        ball_(position_of(v), radius) {}

  /// Runs the three phases, and leaves the pieces of the answer in the searcher.
  void run(double radius, double radius_ratio) {
    scratch_.pieces.clear();
    climb_up(radius / radius_ratio);
    breadth_first_search();
    range_search();
  }

  /// Returns an upper bound of the size of the answer.
  [[nodiscard]] std::size_t max_size() const {
    std::size_t result = 0;
    for (const Piece& piece : scratch_.pieces) result += piece.size();
    return result;
  }

  void collect(std::vector<VertexId>& out) const;
  void collect(std::vector<VertexId>& out, std::vector<double>& distances) const;
  [[nodiscard]] std::size_t count() const;
  void collect(std::vector<VertexRange>& out) const;

 private:
  friend struct SearcherAccess;  // times the phases one by one

  [[nodiscard]] const Level<Real>& level() const { return hierarchy_.levels[level_]; }

  /// Finds the position of `v` by a scan of its lowest cluster, which has few vertices unless there is a hub.
  [[nodiscard]] Point position_of(VertexId v) const {
    const auto first = hierarchy_.vertices.begin() + hierarchy_.levels.front().first_vertex[cluster_];
    const auto position = std::find(first, hierarchy_.vertices.end(), v) - hierarchy_.vertices.begin();
    return point<Real>(hierarchy_.positions, static_cast<std::size_t>(position));
  }

  /// Phase 1: goes to the ancestor of the lowest cluster of `v` on the first level with `ar >= d / f`, where `ar` is
  /// the mean radius of the level, or on the highest level.
  void climb_up(double wanted_radius) {
    while (level_ + 1 < hierarchy_.levels.size() && level().mean_radius < wanted_radius) {
      cluster_ = level().parent[cluster_];
      ++level_;
    }
    searcher_.profile_ = {.level = level().number};
  }

  /// Phase 2: finds `SC`, the clusters that intersect the ball and are connected to that of `v` through such clusters.
  void breadth_first_search() {
    std::vector<ClusterId>& reached = scratch_.reached;
    const std::uint32_t query = searcher_.next_query();
    reached.assign(1, cluster_);
    scratch_.visited[cluster_] = query;
    for (std::size_t head = 0; head < reached.size(); ++head) {
      for (const ClusterId sibling : level().siblings.view()[reached[head]]) {
        if (std::exchange(scratch_.visited[sibling], query) == query) continue;
        if (ball_.classify(level().spheres[sibling]) != Containment::Outside) reached.push_back(sibling);
      }
    }
    searcher_.profile_.clusters_reached = reached.size();
  }

  /// Phase 3: finds the vertices of `SC` in the ball. Deviation: the paper tests each of them. Here a cluster inside
  /// the ball is taken as a whole, and one that intersects its surface is replaced by its children. The answer is the
  /// same; only vertices near the surface are tested.
  void range_search() {
    std::vector<ClusterId>& clusters = scratch_.reached;
    for (;; --level_) {
      scratch_.refined.clear();
      for (const ClusterId cluster : clusters) search_cluster(cluster);
      if (level_ == 0) break;
      std::swap(clusters, scratch_.refined);
    }
  }

  void search_cluster(ClusterId cluster) {
    const Containment containment = ball_.classify(level().spheres[cluster]);
    if (containment == Containment::Outside) return;
    if (containment == Containment::Inside || level_ == 0) {
      add_piece({level().first_vertex[cluster], level().first_vertex[cluster + 1], containment == Containment::Inside});
      return;
    }
    for (ClusterId c = level().first_child[cluster]; c < level().first_child[cluster + 1]; ++c) {
      scratch_.refined.push_back(c);
    }
  }

  void add_piece(const Piece& piece) {
    scratch_.pieces.push_back(piece);
    if (!piece.inside) searcher_.profile_.vertices_tested += piece.size();
  }

  Searcher& searcher_;
  Scratch& scratch_;
  const Hierarchy<Real>& hierarchy_;
  std::size_t level_ = 0;  // counted from the lowest level that is kept
  ClusterId cluster_;
  SearchBall ball_;
};

template <class Real>
void Searcher::Query<Real>::collect(std::vector<VertexId>& out) const {
  const std::vector<VertexId>& vertices = hierarchy_.vertices;
  out.resize(max_size());
  auto end = out.begin();
  for (const Piece& piece : scratch_.pieces) {
    if (piece.inside) {
      end = std::copy(vertices.begin() + piece.begin, vertices.begin() + piece.end, end);
      continue;
    }
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      // Branch-free, because a branch would often be mispredicted.
      *end = vertices[i];
      end += static_cast<std::ptrdiff_t>(ball_.contains(point<Real>(hierarchy_.positions, i)));
    }
  }
  out.resize(static_cast<std::size_t>(end - out.begin()));
}

template <class Real>
void Searcher::Query<Real>::collect(std::vector<VertexId>& out, std::vector<double>& distances) const {
  // Both are reserved first, so that neither has changed if memory runs out.
  out.reserve(max_size());
  distances.reserve(max_size());
  out.clear();
  distances.clear();
  for (const Piece& piece : scratch_.pieces) {
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      const Point p = point<Real>(hierarchy_.positions, i);
      if (!piece.inside && !ball_.contains(p)) continue;
      out.push_back(hierarchy_.vertices[i]);
      distances.push_back(std::sqrt(squared_distance(p, ball_.center())));
    }
  }
}

template <class Real>
std::size_t Searcher::Query<Real>::count() const {
  std::size_t total = 0;
  for (const Piece& piece : scratch_.pieces) {
    if (piece.inside) {
      total += piece.size();
      continue;
    }
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      total += static_cast<std::size_t>(ball_.contains(point<Real>(hierarchy_.positions, i)));
    }
  }
  return total;
}

template <class Real>
void Searcher::Query<Real>::collect(std::vector<VertexRange>& out) const {
  out.clear();
  for (const Piece& piece : scratch_.pieces) {
    if (piece.inside) {
      out.push_back({piece.begin, piece.end});
      continue;
    }
    for (VertexId i = piece.begin; i < piece.end; ++i) {
      if (ball_.contains(point<Real>(hierarchy_.positions, i))) append_to(out, i);
    }
  }
}

void validate(const QueryOptions& options) {
  if (std::isfinite(options.radius_ratio) && options.radius_ratio > 0) return;
  raise(ErrorCode::InvalidOption,
        "radius_ratio is " + to_text(options.radius_ratio) + ", expected a finite number > 0");
}

Searcher::Searcher(const Index& index, const QueryOptions& options)
    : storage_(index.storage_.share()), scratch_(std::make_unique<Scratch>()) {
  set_options(options);
  const std::size_t clusters =
      std::visit([](const auto& hierarchy) { return hierarchy.levels.front().size(); }, storage_->hierarchy);
  scratch_->visited.assign(clusters, 0);
}

void Searcher::set_options(const QueryOptions& options) {
  validate(options);
  options_ = options;
}

std::size_t Searcher::vertex_count() const { return permutation().size(); }

std::span<const VertexId> Searcher::permutation() const& {
  return std::visit([](const auto& hierarchy) { return std::span(hierarchy.vertices); }, storage_->hierarchy);
}

std::uint32_t Searcher::next_query() {
  if (++scratch_->query == 0) {
    std::ranges::fill(scratch_->visited, 0);
    scratch_->query = 1;
  }
  return scratch_->query;
}

template <class F>
void Searcher::run(VertexId v, double radius, F&& answer) {
  std::visit(
      [&]<class Real>(const Hierarchy<Real>& hierarchy) {
        check_query(v, hierarchy.vertices.size(), radius);
        Query<Real> query(*this, hierarchy, v, radius);
        query.run(radius, options_.radius_ratio);
        answer(query);
      },
      storage_->hierarchy);
}

void Searcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out) {
  run(v, radius, [&](auto& query) { query.collect(out); });
}

void Searcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  run(v, radius, [&](auto& query) { query.collect(out, distances); });
}

std::span<const VertexRange> Searcher::ranges(Vertex v, double radius) & {
  run(v, radius, [&](auto& query) { query.collect(scratch_->ranges); });
  return scratch_->ranges;
}

std::size_t Searcher::count(Vertex v, double radius) {
  std::size_t result = 0;
  run(v, radius, [&](auto& query) { result = query.count(); });
  return result;
}

}  // namespace meshhood::inline v0_1::paper
