// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "paper/draft.h"

namespace meshhood::paper {

/// The priority queue `Q` of sec. 3.2. The candidate of cluster `C` has as children those of `C` and its siblings that
/// have no parent yet. So the number of `C` identifies the candidate, and only the count of its children is stored.
class CandidateQueue {
 public:
  /// children[c]: the number of children of the candidate of cluster `c`.
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

/// The number of children of each candidate at first: its cluster and all siblings.
[[nodiscard]] std::vector<VertexId> create(const DraftLevel& below);

}  // namespace meshhood::paper
