// SPDX-License-Identifier: MIT
#include "exact/query/path_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshhood {
namespace {

// So that a bucket has about ten paths where the answer has 10,000 vertices.
constexpr double kBucketsPerEdge = 32;

}  // namespace

void PathSearch::run(std::uint32_t slot, double radius, const LaneFilter& walls) {
  unreached_ = std::nextafter(radius, std::numeric_limits<double>::infinity());  // mutant: path-of-the-radius-refused
  start(slot, walls);
  const auto is_least = [this](const Path& path) {
    return path.length == lengths_[path.end];  // mutant: longer-path-settles-again
  };
  const auto prefetch = [this](const Path& path) { graph_.prefetch_edges(path.end); };
  for (Path next; queue_.pop(next, is_least, prefetch);) {
    found_.push_back({next.length, graph_.vertex(next.end)});
    follow_edges(next, walls);
  }
}

void PathSearch::start(std::uint32_t slot, const LaneFilter& walls) {
  graph_.clear();
  lengths_.clear();
  found_.clear();
  const std::uint32_t first = graph_.local(slot);
  static_cast<void>(graph_.edges(first));
  add_met_leaves(walls);
  queue_.clear(graph_.mean_length() / kBucketsPerEdge);
  if (lengths_[first] == 0) return;  // a wall
  lengths_[first] = 0;
  *queue_.room(1) = {0, first};
  queue_.push(1, 0);
}

void PathSearch::follow_edges(const Path& path, const LaneFilter& walls) {
  const std::span<const LocalGraph::Edge> edges = graph_.edges(path.end);
  if (lengths_.size() != kLeafCapacity * graph_.leaf_count()) add_met_leaves(walls);
  // Whether a path is shorter than those before cannot be predicted, so there is no branch.
  Path* const shorter = queue_.room(edges.size());
  std::size_t count = 0;
  double least = unreached_;
  for (const LocalGraph::Edge& edge : edges) {
    const Path next{path.length + edge.length, edge.neighbor};
    const double before = lengths_[edge.neighbor];
    lengths_[edge.neighbor] = std::min(before, next.length);
    shorter[count] = next;
    count += next.length < before ? 1 : 0;
    least = std::min(least, next.length);
  }
  queue_.push(count, least);
}

/// Initializes the lengths of leaves. That of a wall is 0, so that no path to it is shorter.
void PathSearch::add_met_leaves(const LaneFilter& walls) {
  const std::size_t known = lengths_.size() / kLeafCapacity;
  lengths_.resize(kLeafCapacity * graph_.leaf_count(), unreached_);
  if (walls.empty()) return;
  for (std::size_t leaf = known; leaf < graph_.leaf_count(); ++leaf) {
    for_each_lane(walls.of(graph_.leaf(leaf)), [&](unsigned lane) { lengths_[kLeafCapacity * leaf + lane] = 0; });
  }
}

}  // namespace meshhood
