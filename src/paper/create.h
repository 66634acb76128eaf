// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "paper/draft.h"

namespace meshhood::paper {

/// The priority queue `Q` of sec. 3.2. The candidate made from cluster `C` has as children `C` and the siblings of `C`
/// that no selected cluster has taken; so a number says which candidate it is, and only its count of children is kept.
class CandidateQueue {
 public:
  /// children[c]: of the candidate made from cluster `c`.
  explicit CandidateQueue(const std::vector<VertexId>& children);

  struct Candidate {
    double from_average;  ///< its key: how far its number of children is from the average
    VertexId children;
    ClusterId cluster;
  };

  [[nodiscard]] bool empty() const { return queue_.empty(); }
  Candidate pop();
  void insert(ClusterId cluster, VertexId children);

 private:
  /// Equal keys go by id, so that the order is total.
  struct ComesLater {
    bool operator()(const Candidate& a, const Candidate& b) const {
      return a.from_average != b.from_average ? a.from_average > b.from_average : a.cluster > b.cluster;
    }
  };

  [[nodiscard]] Candidate make(ClusterId cluster, VertexId children) const;

  double average_ = 0;
  std::priority_queue<Candidate, std::vector<Candidate>, ComesLater> queue_;
};

/// How many children each candidate begins with: its cluster and all siblings of it.
[[nodiscard]] std::vector<VertexId> create(const DraftLevel& below);

}  // namespace meshhood::paper
