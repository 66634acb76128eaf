// SPDX-License-Identifier: MIT
// Step 1 of sec. 3.2, create: one candidate for each cluster of the level below, in a priority queue ordered by how far
// its number of children is from the average.
#include <cmath>
#include <numeric>
#include <utility>

#include "paper/draft.h"

namespace meshhood::inline v0_1::paper {

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

}  // namespace meshhood::inline v0_1::paper
