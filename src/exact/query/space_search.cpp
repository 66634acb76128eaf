// SPDX-License-Identifier: MIT
#include "exact/query/space_search.h"

#include <algorithm>

#include "exact/node_search.h"
#include "exact/query/arguments.h"

namespace meshhood {

SpaceSearcher::SpaceSearcher(const Index& index)
    : index_(index),
      kernels_(&kernels(best_isa())),
      center_(index_->frame, {0, 0, 0}),
      ball_({0, 0, 0}, LeafBounds(0)),
      answer_(*index_) {}

std::span<const VertexId> SpaceSearcher::permutation() const {
  const std::span<const VertexId> padded = index_->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

std::vector<VertexId> SpaceSearcher::neighborhood(VertexId v, double radius) {
  std::vector<VertexId> out;
  neighborhood(v, radius, out);
  return out;
}

void SpaceSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  search(v, radius);
  replace_ids(answer_, *index_, *kernels_, out);
}

void SpaceSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out,
                                 std::vector<double>& distances) {
  search(v, radius);
  distances.reserve(answer_.count());  // before `out` changes: if this throws, neither has changed
  replace_ids(answer_, *index_, *kernels_, out);
  distances.resize(out.size());
  write_distances(answer_, *index_, center_.exact, distances.data());
}

std::span<const VertexRange> SpaceSearcher::ranges(VertexId v, double radius) {
  search(v, radius);
  return answer_.ranges();
}

std::size_t SpaceSearcher::count(VertexId v, double radius) {
  search(v, radius);
  return answer_.count();
}

void SpaceSearcher::search(VertexId v, double radius) {
  index_.check_current();
  check_query(v, vertex_count(), radius);
  center_ = Center(index_->frame, position_of(*index_, v));
  ball_ = LeafBall(center_.exact, LeafBounds(radius));
  found_.clear();
  visit_roots(index_->roots.levels.size() - 1, 0);
  // Root groups are in no order.
  std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  answer_.clear();
  for (const VertexSet::Part& part : found_) {
    const VertexRange vertices{part.begin, part.end};
    part.is_run() ? answer_.add(vertices) : answer_.add_lanes(vertices, part.lanes);
  }
}

/// Visits up to eight spheres of a level over the root groups, from `first` on.
void SpaceSearcher::visit_roots(std::size_t level, std::size_t first) {
  const RootTree& roots = index_->roots;
  const std::size_t end = std::min(first + kFanOut, roots.levels[level].size());
  for (std::size_t i = first; i < end; ++i) {
    if (squared_distances(roots.levels[level][i], center_).low > ball_.squared_radius) continue;
    level == 0 ? visit_group(roots.groups[i]) : visit_roots(level - 1, i * kFanOut);
  }
}

void SpaceSearcher::visit_group(std::size_t group) {
  const GroupRecord& record = index_->records[group];
  for (unsigned place = 0; place < record.nodes; ++place) {
    const SquareRange squares = squared_distances(sphere_of(index_->groups[group], place), center_);
    const std::size_t node = group * kFanOut + place;
    if (squares.low > ball_.squared_radius) continue;
    if (squares.high <= ball_.squared_radius) {
      const VertexRange run = run_of(record, place);
      if (run.begin < run.end) found_.push_back({run.begin, run.end, 0});
    } else if (node < index_->leaf_count()) {
      visit_leaf(static_cast<LeafId>(node));
    } else {
      visit_group(record.first_child + place);
    }
  }
}

void SpaceSearcher::visit_leaf(LeafId leaf) {
  const VertexId begin = index_->leaf_begin[leaf];
  const VertexId end = index_->leaf_begin[leaf + 1];
  if (begin == end) return;
  const LaneMask lanes = kernels_->within(index_->positions, begin, end - begin, ball_);
  if (lanes != 0) found_.push_back({begin, end, lanes});
}

}  // namespace meshhood
