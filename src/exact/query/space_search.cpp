// SPDX-License-Identifier: MIT
#include "exact/query/space_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "exact/node_search.h"
#include "exact/query/arguments.h"

namespace meshhood::inline v0_1 {
namespace {

struct SpaceQueries final : SingleQueries {
  SpaceQueries(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Isa chosen)
      : SingleQueries(std::move(bound), std::move(kept), Metric::Space, chosen), search_(*index, *kernels) {}

  VertexSet& search(const Start& start, double radius) override {
    check(start);
    check_radius(radius);
    start.center() ? search_.search(center_of(start), radius) : search_.search(start.vertex(), radius);
    return search_.answer;
  }

  void collect(const Start& start, double radius, std::vector<LeafSubset>& found) override {
    search(start, radius).collect(found);
  }

  bool contains(const Start& start, VertexId w, double radius) override {
    const std::size_t place = index->place(w);
    if (index->is_wall_at(place) || index->is_ignored_at(place)) return false;
    if (!start.center() && index->is_wall_at(index->place(start.vertex()))) return false;
    return distance_to(w, start) <= radius;
  }

  double connecting_radius(const Start& start, VertexId w) override {
    const double distance = distance_to(w, start);
    return contains(start, w, distance) ? distance : kNoRadius;
  }

  void nearest(const Start& /*start*/, std::size_t /*k*/, std::vector<VertexId>& /*ids*/,
               std::vector<double>& /*radii*/) override {
    check_connects(metric);
  }

 private:
  [[nodiscard]] double distance_to(VertexId w, const Start& start) const {
    return std::sqrt(squared_distance(index->position_of(w), center_of(start)));
  }

  SpaceSearch search_;
};

}  // namespace

SpaceSearch::SpaceSearch(const IndexView& index, const Kernels& kernels)
    : answer(index),
      index_(&index),
      kernels_(&kernels),
      center_(index.frame, {0, 0, 0}),
      ball_({0, 0, 0}, LeafBounds(0)) {}

void SpaceSearch::search(VertexId v, double radius) {
  if (index_->is_wall_at(index_->place(v))) return answer.clear();
  search(index_->position_of(v), radius);
}

void SpaceSearch::search(const Point& center, double radius) {
  center_ = Center(index_->frame, center);
  ball_ = any_ball(center, radius);
  found_.clear();
  if (!index_->roots.levels.empty()) visit_roots(index_->roots.levels.size() - 1, 0);
  // Root groups are in no order.
  std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  answer.clear();
  for (const VertexSet::Part& part : found_) {
    const VertexRange vertices{part.begin, part.end};
    part.is_run() ? answer.add(vertices) : answer.add_lanes(vertices, part.lanes);
  }
  for (const auto& mask : {index_->walls, index_->ignored}) {
    if (!mask.empty()) answer.leave_out(mask);
  }
}

/// Visits up to eight spheres of a level over the root groups, from `first` on.
void SpaceSearch::visit_roots(std::size_t level, std::size_t first) {
  const RootTree& roots = index_->roots;
  const std::size_t end = std::min(first + kFanOut, roots.levels[level].size());
  for (std::size_t i = first; i < end; ++i) {
    if (squared_distances(roots.levels[level][i], center_).low > ball_.squared_radius) continue;
    level == 0 ? visit_group(roots.groups[i]) : visit_roots(level - 1, i * kFanOut);
  }
}

void SpaceSearch::visit_group(std::size_t group) {
  const GroupRecord& record = index_->records[group];
  for (unsigned place = 0; place < record.nodes; ++place) {
    const SquareRange squares = squared_distances(sphere_of(index_->groups[group], place), center_);
    const std::size_t node = group * kFanOut + place;
    if (squares.low > ball_.squared_radius) continue;
    if (squares.high <= ball_.squared_radius) {
      const VertexRange run = run_of(record, place);
      if (run.begin < run.end) found_.push_back({run.begin, run.end, 0});
    } else if (node < index_->leaf_count()) {
      visit_leaf(static_cast<LeafId>(node));
    } else {
      visit_group(record.first_child + place);
    }
  }
}

void SpaceSearch::visit_leaf(LeafId leaf) {
  const VertexId begin = index_->leaf_begin[leaf];
  const VertexId end = index_->leaf_begin[leaf + 1];
  if (begin == end) return;
  const LaneMask lanes = kernels_->within(index_->positions, begin, end - begin, ball_);
  if (lanes != 0) found_.push_back({begin, end, lanes});
}

std::unique_ptr<SingleQueries> make_space_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph, Isa isa) {
  return std::make_unique<SpaceQueries>(std::move(index), std::move(graph), isa);
}

}  // namespace meshhood::inline v0_1
