// SPDX-License-Identifier: MIT
// Implements step 4 of sec. 3.2, fusion: Algorithm 2. Deviation: it runs before step 3, because it only needs the
// parents of the clusters. So there are no siblings or spheres yet to update.
#include <queue>
#include <utility>

#include "paper/draft.h"

namespace meshhood::inline v0_1::paper {
namespace {

class Fusion {
 public:
  Fusion(const DraftLevel& below, double threshold, Partition& partition)
      : below_(below),
        threshold_(threshold),
        partition_(partition),
        first_child_(partition.clusters, kNoCluster),
        next_child_(below.size(), kNoCluster),
        child_count_(partition.clusters, 0),
        vertex_count_(partition.clusters, 0),
        position_sum_(partition.clusters, Point{}) {
    // The loop runs backwards, so that each list of children ascends.
    for (std::size_t c = below.size(); c-- > 0;) add_child(partition.parent[c], static_cast<ClusterId>(c));
  }

  /// Dissolves small clusters, the smallest first: children of one below the threshold move to clusters at least as
  /// large, so none moves often. Each cluster that is dissolved is one less, so the loop ends.
  void run() {
    for (std::size_t c = 0; c < partition_.clusters; ++c) queue_if_small(static_cast<ClusterId>(c));
    while (!donors_.empty()) {
      const auto [vertices, cluster] = donors_.top();
      donors_.pop();
      if (vertices == vertex_count_[cluster]) {
        dissolve(cluster);
      } else {
        queue_if_small(cluster);  // it has grown since it was queued
      }
    }
    number_survivors();
  }

 private:
  using Entry = std::pair<VertexId, ClusterId>;

  /// Deviation: a cluster with a single child is dissolved, however large it is. Otherwise levels need not shrink: on a
  /// star, select alone removes one cluster from each level.
  void queue_if_small(ClusterId cluster) {
    if (static_cast<double>(vertex_count_[cluster]) < threshold_ || child_count_[cluster] < 2) {
      donors_.emplace(vertex_count_[cluster], cluster);
    }
  }

  void add_child(ClusterId parent, ClusterId child) {
    partition_.parent[child] = parent;
    next_child_[child] = std::exchange(first_child_[parent], child);
    ++child_count_[parent];
    vertex_count_[parent] = static_cast<VertexId>(vertex_count_[parent] + below_.vertex_count[child]);
    const Point& sum = below_.position_sum[child];
    Point& total = position_sum_[parent];
    total = {total.x + sum.x, total.y + sum.y, total.z + sum.z};
  }

  /// Dissolves a cluster by Algorithm 2, whose D is `donor`. Deviation: a child goes to the nearest cluster that it
  /// touches. In the paper it goes to nearSibling, the nearest sibling of the donor, which it need not touch; that
  /// cluster would be disconnected. Children inside the donor, which touch no other cluster, follow after a neighbor
  /// has moved: the donor is connected, so all are reached. Deviation: a donor without siblings stays; in the paper its
  /// vertices would be lost.
  void dissolve(ClusterId donor) {
    to_move_.clear();
    for (ClusterId child = first_child_[donor]; child != kNoCluster; child = next_child_[child]) {
      if (nearest_touching(child, donor) != kNoCluster) to_move_.push_back(child);
    }
    if (to_move_.empty()) return;
    first_child_[donor] = kNoCluster;
    child_count_[donor] = 0;
    vertex_count_[donor] = 0;
    for (std::size_t i = 0; i < to_move_.size(); ++i) {
      const ClusterId child = to_move_[i];
      if (partition_.parent[child] != donor) continue;
      add_child(nearest_touching(child, donor), child);
      for (const ClusterId sibling : below_.siblings[child]) {
        if (partition_.parent[sibling] == donor) to_move_.push_back(sibling);
      }
    }
  }

  /// Deviation: the distance between clusters is that of the means of their vertices, which stays exact as they grow.
  [[nodiscard]] ClusterId nearest_touching(ClusterId child, ClusterId donor) const {
    const Point center = mean(below_.position_sum[child], below_.vertex_count[child]);
    ClusterId nearest = kNoCluster;
    double smallest = kInfinity;
    for (const ClusterId sibling : below_.siblings[child]) {
      const ClusterId cluster = partition_.parent[sibling];
      if (cluster == donor || cluster == nearest) continue;
      const double d2 = squared_distance(center, mean(position_sum_[cluster], vertex_count_[cluster]));
      if (d2 < smallest || (d2 == smallest && cluster < nearest)) {
        smallest = d2;
        nearest = cluster;
      }
    }
    return nearest;
  }

  [[nodiscard]] static Point mean(const Point& sum, VertexId count) {
    const auto n = static_cast<double>(count);
    return {sum.x / n, sum.y / n, sum.z / n};
  }

  void number_survivors() {
    std::vector<ClusterId> number(partition_.clusters, kNoCluster);
    partition_.clusters = 0;
    for (ClusterId& parent : partition_.parent) {
      if (number[parent] == kNoCluster) number[parent] = static_cast<ClusterId>(partition_.clusters++);
      parent = number[parent];
    }
  }

  const DraftLevel& below_;
  double threshold_;
  Partition& partition_;
  // The children of each cluster, as linked lists.
  std::vector<ClusterId> first_child_;
  std::vector<ClusterId> next_child_;
  std::vector<VertexId> child_count_;
  std::vector<VertexId> vertex_count_;
  std::vector<Point> position_sum_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> donors_;
  std::vector<ClusterId> to_move_;
};

}  // namespace

void fuse(const DraftLevel& below, double threshold, Partition& partition) {
  Fusion(below, threshold, partition).run();
}

}  // namespace meshhood::inline v0_1::paper
