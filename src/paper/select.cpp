// SPDX-License-Identifier: MIT
// Step 2 of sec. 3.2, select: Algorithm 1, a greedy cover. A candidate that has lost children since it was queued goes
// back with its new count; one that has all of them becomes a cluster. O(#siblings log #clusters).
#include "paper/select.h"

#include <utility>

namespace meshhood::paper {
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
      // Deviation: a candidate whose own cluster has been taken is dropped whole, where Algorithm 1 goes on with what
      // is left of it. The rest hangs together through that cluster alone, and each of the rest still has a candidate
      // of its own; so every cluster made here is connected, as sec. 3.1 demands.
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

  void add_cluster(ClusterId centre) {
    const auto parent = static_cast<ClusterId>(partition_.clusters++);
    visit(centre, parent);
    for (const ClusterId child : below_.siblings[centre]) {
      if (!visited(child)) visit(child, parent);
    }
  }

  /// The visited child is deleted from every candidate that counts it.
  void visit(ClusterId child, ClusterId parent) {
    partition_.parent[child] = parent;
    --children_[child];
    for (const ClusterId sibling : below_.siblings[child]) --children_[sibling];
  }

  const DraftLevel& below_;
  std::vector<VertexId> children_;  // that are not visited, by candidate
  Partition partition_;
};

}  // namespace

Partition select(const DraftLevel& below, std::vector<VertexId> children) {
  return Selection(below, std::move(children)).run();
}

}  // namespace meshhood::paper
