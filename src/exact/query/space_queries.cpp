// SPDX-License-Identifier: MIT
// Answers queries in space, connected or not, by the tree of the index: a node inside the ball is taken as a whole, one
// outside is skipped.
#include <algorithm>
#include <cmath>
#include <utility>

#include "exact/node_search.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "exact/query/single_queries.h"
#include "simd/ball.h"

namespace meshhood::inline v0_1 {
namespace {

struct SpaceQueries final : SingleQueries {
  SpaceQueries(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Isa chosen)
      : SingleQueries(std::move(bound), std::move(kept), Metric::Space, chosen),
        center_(index->frame, {0, 0, 0}),
        ball_({0, 0, 0}, LeafBounds(0)) {}

  VertexSet& search(const Start& start, double radius) override;

  void collect(const Start& start, double radius, std::vector<LeafSubset>& found) override {
    search(start, radius).collect(found);
  }

  bool contains(const Start& start, VertexId w, double radius) override {
    const std::uint32_t slot = index->slot[w];
    if (index->is_wall(slot) || index->is_ignored(slot) || is_wall(start)) return false;
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
  [[nodiscard]] bool is_wall(const Start& start) const {
    return !start.center() && index->is_wall(index->slot[start.vertex()]);
  }

  [[nodiscard]] double distance_to(VertexId w, const Start& start) const {
    return std::sqrt(squared_distance(index->position_of(w), center_of(start)));
  }

  void visit_roots(std::size_t level, std::size_t first);
  void visit_group(std::size_t group);
  void visit_leaf(LeafId leaf);

  Center center_;
  LeafBall ball_;
  std::vector<VertexSet::Part> found_;  // root group by root group, ascending within each
};

VertexSet& SpaceQueries::search(const Start& start, double radius) {
  check(start);
  check_radius(radius);
  answer.clear();
  if (is_wall(start)) return answer;
  center_ = Center(index->frame, center_of(start));
  ball_ = any_ball(center_.exact, radius);
  found_.clear();
  if (!index->roots.levels.empty()) visit_roots(index->roots.levels.size() - 1, 0);
  // Root groups are in no order.
  std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  for (const VertexSet::Part& part : found_) {
    const VertexRange vertices{part.begin, part.end};
    part.is_run() ? answer.add(vertices) : answer.add_lanes(vertices, part.lanes);
  }
  for (const auto& mask : {index->walls, index->ignored}) {
    if (!mask.empty()) answer.leave_out(mask);
  }
  return answer;
}

/// Visits up to eight spheres of a level over the root groups, from `first` on.
void SpaceQueries::visit_roots(std::size_t level, std::size_t first) {
  const RootTree& roots = index->roots;
  const std::size_t end = std::min(first + kFanOut, roots.levels[level].size());
  for (std::size_t i = first; i < end; ++i) {
    if (squared_distances(roots.levels[level][i], center_).low > ball_.squared_radius) continue;
    level == 0 ? visit_group(roots.groups[i]) : visit_roots(level - 1, i * kFanOut);
  }
}

void SpaceQueries::visit_group(std::size_t group) {
  const GroupRecord& record = index->records[group];
  for (unsigned place = 0; place < record.nodes; ++place) {
    const SquareRange squares = squared_distances(sphere_of(index->groups[group], place), center_);
    const std::size_t node = group * kFanOut + place;
    if (squares.low > ball_.squared_radius) continue;
    if (squares.high <= ball_.squared_radius) {
      const VertexRange run = run_of(record, place);
      if (run.begin < run.end) found_.push_back({run.begin, run.end, 0});
    } else if (node < index->leaf_count()) {
      visit_leaf(static_cast<LeafId>(node));
    } else {
      visit_group(record.first_child + place);
    }
  }
}

void SpaceQueries::visit_leaf(LeafId leaf) {
  const VertexId begin = index->leaf_begin[leaf];
  const VertexId end = index->leaf_begin[leaf + 1];
  if (begin == end) return;
  const LaneMask lanes = kernels->within(index->positions, begin, end - begin, ball_);
  if (lanes != 0) found_.push_back({begin, end, lanes});
}

}  // namespace

std::unique_ptr<SingleQueries> make_space_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph, Isa isa) {
  return std::make_unique<SpaceQueries>(std::move(index), std::move(graph), isa);
}

}  // namespace meshhood::inline v0_1
