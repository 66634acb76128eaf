// SPDX-License-Identifier: MIT
// The points near those of a leaf are in the leaves near it, which the tree of an index without edges finds.
#include "meshhood/link_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/index_access.h"
#include "exact/query/any_center.h"
#include "exact/query/nearest_first.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood {
namespace {

constexpr std::size_t kLeavesAtOnce = 16;

/// Lists the points that may be near those of a leaf.
class NearPoints : public VertexVisitor {
 public:
  NearPoints(const IndexView& index, double link) : index_(&index), link_(link), squared_link_(squared_radius(link)) {}

  /// Lists those near a leaf, and those of the leaf itself.
  void list(LeafId leaf) {
    ids_.clear();
    x_.clear();
    y_.clear();
    z_.clear();
    const Frame& frame = index_->frame;
    const Center center(frame, frame.origin + (1 / frame.scale) * center_of(index_->leaves[leaf].bounds));
    double radius = 0;
    for (unsigned lane = 0; lane < index_->leaves[leaf].size; ++lane) {
      radius = std::max(radius, std::sqrt(squared_distance(center.exact, index_->position(leaf, lane))));
    }
    reach_ = reach_of(radius + link_);
    NearestFirst(*index_, center, *this).run();
  }

  [[nodiscard]] double reach() const { return reach_; }

  void visit_leaf(LeafId leaf) {
    for (unsigned lane = 0; lane < index_->leaves[leaf].size; ++lane) {
      const Point p = index_->position(leaf, lane);
      ids_.push_back(index_->id(std::size_t{index_->leaf_begin[leaf]} + lane));
      x_.push_back(p.x);
      y_.push_back(p.y);
      z_.push_back(p.z);
    }
  }

  /// The number of listed points within the link of `p`, without branches.
  [[nodiscard]] std::size_t count(const Point& p) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < ids_.size(); ++i) count += is_near(p, i) ? 1 : 0;
    return count;
  }

  /// Writes their ids but `self`, ascending.
  void write(const Point& p, VertexId self, std::span<VertexId> out) const {
    VertexId* next = out.data();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (is_near(p, i) && ids_[i] != self) *next++ = ids_[i];
    }
    std::sort(out.begin(), out.end());
  }

 private:
  [[nodiscard]] bool is_near(const Point& p, std::size_t i) const {
    return squared_distance(p, {x_[i], y_[i], z_[i]}) <= squared_link_;
  }

  const IndexView* index_;
  double link_;
  double squared_link_;
  double reach_ = 0;
  std::vector<VertexId> ids_;
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> z_;
};

/// Calls `f(id, position, near)` for all points, on any thread. `near` lists the points that may be near.
template <class F>
void for_each_point(const IndexView& index, double link, TaskContext& task, F&& f) {
  task.parallel_for(index.leaf_count(), kLeavesAtOnce, [&](unsigned thread, std::size_t begin, std::size_t end) {
    NearPoints near(index, link);
    for (auto leaf = static_cast<LeafId>(begin); leaf < end && task.should_continue(thread); ++leaf) {
      if (index.leaves[leaf].size == 0) continue;
      near.list(leaf);
      for (unsigned lane = 0; lane < index.leaves[leaf].size; ++lane) {
        f(index.id(std::size_t{index.leaf_begin[leaf]} + lane), index.position(leaf, lane), near);
      }
    }
    task.advance(end - begin);
  });
}

Index index_without_edges(const PositionsView& points, unsigned threads) {
  const std::vector<EdgeOffset> none(points.size() + 1);
  return build(GraphView{points, AdjacencyView(none, {})}, {.threads = threads});
}

}  // namespace

Adjacency link_points(const PositionsView& points, double link, const LinkOptions& options) {
  if (!(link >= 0 && std::isfinite(link))) {
    raise(ErrorCode::InvalidOption, "link: " + to_text(link) + ", expected a finite number >= 0");
  }
  const std::size_t most = std::min(options.max_edges, kMaxNeighbors / 2);
  const Index index = index_without_edges(points, options.threads);
  const IndexView& view = IndexAccess::view(index);
  TaskContext task(options.threads, options.progress, 2 * view.leaf_count());
  Adjacency graph;
  graph.offsets.assign(points.size() + 1, 0);
  std::atomic<std::size_t> neighbors{0};
  for_each_point(view, link, task, [&](VertexId id, const Point& p, const NearPoints& near) {
    const std::size_t count = near.count(p) - 1;  // without itself
    if (neighbors.fetch_add(count, std::memory_order_relaxed) + count > 2 * most) {
      raise(ErrorCode::TooLarge, "link: " + to_text(link) + " joins the " + std::to_string(points.size()) +
                                     " points by more than " + std::to_string(most) +
                                     " edges, expected a smaller link");
    }
    graph.offsets[id + std::size_t{1}] = static_cast<EdgeOffset>(count);
  });
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.neighbors.resize(graph.offsets.back());
  for_each_point(view, link, task, [&](VertexId id, const Point& p, const NearPoints& near) {
    const std::size_t begin = graph.offsets[id];
    near.write(p, id, std::span(graph.neighbors).subspan(begin, graph.offsets[id + std::size_t{1}] - begin));
  });
  task.finish();
  return graph;
}

}  // namespace meshhood
