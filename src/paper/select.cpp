// SPDX-License-Identifier: MIT
// Step 1 of sec. 3.2, create, makes one candidate for each cluster of the level below, in a priority queue ordered by
// how far its number of children is from the average. Step 2, select, is Algorithm 1, a greedy set cover. A candidate
// that has lost children since it was queued is queued again with its new count; any other becomes a cluster. This
// takes O(#siblings log #clusters).
//
// In the words of Algorithm 1, `top` is T, `visited(c)` is Ci.visited, and T has deletedChildren if its count in
// `children_` is not that of `top`. It always has children, as its own cluster is one until it is dropped.
#include <cmath>
#include <numeric>
#include <utility>

#include "paper/draft.h"

namespace meshhood::inline v0_1::paper {
namespace {

class Selection {
 public:
  Selection(const DraftLevel& below, std::vector<VertexId> children) : below_(below), children_(std::move(children)) {
    partition_.parent.assign(below.size(), kNoCluster);
  }

  Partition run() {
    CandidateQueue queue(children_);
    while (!queue.empty()) {
      const CandidateQueue::Candidate top = queue.pop();
      // Deviation: a candidate whose own cluster already has a parent is dropped, where Algorithm 1 continues with its
      // other children. Those are connected through that cluster alone, and each still has a candidate of its own. So
      // each cluster made here is connected, as sec. 3.1 requires.
      if (visited(top.cluster)) continue;
      if (children_[top.cluster] != top.children) {
        queue.insert(top.cluster, children_[top.cluster]);
      } else {
        add_cluster(top.cluster);
      }
    }
    return std::move(partition_);
  }

 private:
  [[nodiscard]] bool visited(ClusterId c) const { return partition_.parent[c] != kNoCluster; }

  void add_cluster(ClusterId center) {
    const auto parent = static_cast<ClusterId>(partition_.clusters++);
    visit(center, parent);
    for (const ClusterId child : below_.siblings[center]) {
      if (!visited(child)) visit(child, parent);
    }
  }

  /// Removes the visited child from each candidate that counts it.
  void visit(ClusterId child, ClusterId parent) {
    partition_.parent[child] = parent;
    --children_[child];
    for (const ClusterId sibling : below_.siblings[child]) --children_[sibling];
  }

  const DraftLevel& below_;
  std::vector<VertexId> children_;  // by candidate: those not yet visited
  Partition partition_;
};

}  // namespace

std::vector<VertexId> create(const DraftLevel& below) {
  std::vector<VertexId> children(below.size());
  for (std::size_t c = 0; c < below.size(); ++c) children[c] = static_cast<VertexId>(1 + below.siblings[c].size());
  return children;
}

CandidateQueue::CandidateQueue(const std::vector<VertexId>& children)
    : average_(std::accumulate(children.begin(), children.end(), 0.0) / static_cast<double>(children.size())) {
  std::vector<Candidate> candidates;
  candidates.reserve(children.size());
  for (std::size_t c = 0; c < children.size(); ++c) {
    candidates.push_back(make(static_cast<ClusterId>(c), children[c]));
  }
  queue_ = decltype(queue_)(ComesLater{}, std::move(candidates));
}

CandidateQueue::Candidate CandidateQueue::make(ClusterId cluster, VertexId children) const {
  return {std::abs(static_cast<double>(children) - average_), children, cluster};
}

CandidateQueue::Candidate CandidateQueue::pop() {
  const Candidate top = queue_.top();
  queue_.pop();
  return top;
}

void CandidateQueue::insert(ClusterId cluster, VertexId children) { queue_.push(make(cluster, children)); }

Partition select(const DraftLevel& below, std::vector<VertexId> children) {
  return Selection(below, std::move(children)).run();
}

}  // namespace meshhood::inline v0_1::paper
