// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"

#include "base/lists.h"
#include "paper/hierarchy.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1::paper {

/// A level during construction (3.2): what the computation of the next level needs.
struct DraftLevel {
  AdjacencyView siblings;              // of each cluster; on the base level, the graph of the mesh
  Adjacency own_siblings;              // what `siblings` refers to, above the base level
  std::vector<VertexId> vertex_count;  // by cluster
  std::vector<Point> position_sum;     // by cluster: the sum over its vertices; fusion needs the mean

  [[nodiscard]] std::size_t size() const { return vertex_count.size(); }
};

/// The parent of each cluster, on the next level.
struct Partition {
  std::vector<ClusterId> parent;
  std::size_t clusters = 0;
};

inline constexpr ClusterId kNoCluster = static_cast<ClusterId>(-1);

/// The priority queue `Q` of sec. 3.2. The candidate of cluster `C` has as children those of `C` and its siblings that
/// have no parent yet. So the number of `C` identifies the candidate, and only the count of its children is stored.
class CandidateQueue {
 public:
  /// `children[c]` is the number of children of the candidate of cluster `c`.
  explicit CandidateQueue(const std::vector<VertexId>& children);

  struct Candidate {
    double from_average;  ///< the key: distance of its number of children from the average
    VertexId children;
    ClusterId cluster;
  };

  [[nodiscard]] bool empty() const { return queue_.empty(); }
  Candidate pop();
  void insert(ClusterId cluster, VertexId children);

 private:
  /// Ties are broken by id, so the order is total.
  struct ComesLater {
    bool operator()(const Candidate& a, const Candidate& b) const {
      return a.from_average != b.from_average ? a.from_average > b.from_average : a.cluster > b.cluster;
    }
  };

  [[nodiscard]] Candidate make(ClusterId cluster, VertexId children) const;

  double average_ = 0;
  std::priority_queue<Candidate, std::vector<Candidate>, ComesLater> queue_;
};

/// Returns the number of children of each candidate at first: its cluster and all siblings.
[[nodiscard]] std::vector<VertexId> create(const DraftLevel& below);

/// Chooses clusters for the next level until each cluster of `below` has exactly one parent. `children` is the result
/// of `create`.
[[nodiscard]] Partition select(const DraftLevel& below, std::vector<VertexId> children);

/// Dissolves the clusters of `partition` that have fewer than `threshold` vertices or a single child into the clusters
/// they touch. The others are numbered in the order of their first children. A cluster that touches no other is a whole
/// component of the mesh and stays.
void fuse(const DraftLevel& below, double threshold, Partition& partition);

/// Computes the next level: vertices and siblings of each cluster, from those of its children.
[[nodiscard]] DraftLevel link(const DraftLevel& below, const Partition& partition);

/// Returns the children of each parent, ascending. `parent[c]` is the parent of child `c`, below `parents`.
[[nodiscard]] inline Lists<VertexId, VertexId> child_lists(std::span<const VertexId> parent, std::size_t parents) {
  return gather_lists<VertexId, VertexId>(parents, [&](auto&& f) {
    for (std::size_t c = parent.size(); c-- > 0;) f(parent[c], static_cast<VertexId>(c));
  });
}

}  // namespace meshhood::inline v0_1::paper
