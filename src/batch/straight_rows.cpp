// SPDX-License-Identifier: MIT
#include "batch/straight_rows.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "exact/index_access.h"

namespace meshhood {
namespace {

// A packet costs about as much as this many rows of a leaf that are answered one by one with vectors (docs/joint.md).
// With the portable kernels, it costs as much as more rows; but which rows are answered together must not depend on the
// processor, because sums over packets do.
constexpr std::size_t kBreakEven = 8;
constexpr std::size_t kBreakEvenOfLarge = 12;  // where the radius is large
constexpr double kLargeRadius = 5;             // in mean leaf radii

LeafId leaf_of_run(const RowRun& run) { return leaf_of(run.items.front().position); }
LeafId group_of(const RowRun& run) { return leaf_of_run(run) / kFanOut; }

}  // namespace

StraightRows::StraightRows(const Index& index, Metric metric, Isa isa)
    : index_(index),
      view_(IndexAccess::view(index)),
      metric_(metric),
      isa_(isa),
      is_single_(metric == Metric::Space || is_unlike_a_surface(view_)),
      radius_(view_.frame, 0),
      writer_(view_, isa) {}

bool StraightRows::pays(std::span<const BatchItem> items, bool /*distances*/) const {
  if (is_single_) return false;
  const BatchItem& first = items.front();
  const bool is_large = first.radius > kLargeRadius * view_.tree.front().mean_radius / view_.frame.scale;
  // If all vertices of a small leaf are queried, then mostly all vertices of its group are.
  if (is_large && items.size() == view_.leaves[leaf_of(first.position)].size) return true;
  return items.size() >= (is_large ? kBreakEvenOfLarge : kBreakEven);
}

bool StraightRows::run(std::span<const RowRun> runs) {
  const auto& [items, is_joint] = runs.front();
  is_joint_ = is_joint;
  if (is_joint) {
    if (leaves_.empty() || leaves_.front() / kFanOut != group_of(runs.front())) begin_group(runs);
    queries_.clear();
    for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), prepared(item.radius)});
    joint_->run(leaf_of_run(runs.front()), queries_);
  } else {
    found_ = &search(items.front().vertex, items.front().radius);
  }
  return true;
}

VertexSet& StraightRows::search(VertexId v, double radius) {
  if (metric_ == Metric::Space) {
    if (!space_) space_.emplace(view_, kernels(isa_));
    space_->search(v, radius);
    return space_->answer;
  }
  if (!single_) single_.emplace(BoundIndex(index_), IndexAccess::share_graph(index_), isa_);
  single_->search(v, radius);
  return single_->answer;
}

/// With the first run. The radii of its rows belong to the group.
void StraightRows::begin_group(std::span<const RowRun> runs) {
  leaves_.clear();
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  const LeafId group = group_of(runs.front());
  for (const RowRun& run : runs) {
    if (group_of(run) != group) break;
    if (!run.is_joint) continue;
    if (leaves_.empty() || leaves_.back() != leaf_of_run(run)) leaves_.push_back(leaf_of_run(run));
    for (const BatchItem& item : run.items) {
      low = std::min(low, item.radius);
      high = std::max(high, item.radius);
    }
  }
  if (!joint_) joint_.emplace(view_, isa_);
  const TreeBounds low_bounds = prepared(low).bounds;
  joint_->begin_group(leaves_, low_bounds, prepared(high).bounds);
}

const JointRadius& StraightRows::prepared(double radius) {
  if (radius != radius_.radius) radius_ = JointRadius(view_.frame, radius);
  return radius_;
}

const PerLane<std::uint64_t>& StraightRows::counts() {
  if (is_joint_) return joint_->counts();
  counts_[0] = found_->count();
  return counts_;
}

std::span<const Piece> StraightRows::pieces() {
  if (is_joint_) return joint_->pieces();
  if (single_ && single_->way == StraightSearch::Way::VertexBfs) found_->align_to_leaves();
  return pieces_of(*found_);
}

std::span<const Piece> StraightRows::pieces_of(VertexSet& found) {
  constexpr QueryWord kQuery = 1;
  const auto leaf_of_vertex = [&](VertexId vertex) { return leaf_of(view_.slot_at(vertex)); };
  pieces_.clear();
  words_.resize(found.parts().size());
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const auto& [begin, end, lanes] = found.parts()[i];
    assert(begin < end);
    const LeafId leaf = leaf_of_vertex(begin);
    if (lanes == 0) {
      pieces_.push_back({{leaf, leaf_of_vertex(end - 1) + 1}, kQuery, nullptr});
    } else {
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) words_[i][lane] = lanes >> lane & kQuery;
      pieces_.push_back({{leaf, leaf + 1}, 0, words_[i].data()});
    }
  }
  return pieces_;
}

bool StraightRows::write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
                         RowReceiver& receiver) {
  writer_.begin(answers.pieces);
  for (unsigned i = 0; i < items.size(); ++i) {
    const auto& [row, vertex, position, radius] = items[i];
    const BatchMemory memory = receiver.memory(row, answers.counts[i]);
    writer_.write_ids(i, memory.ids);
    if (distances) {
      writer_.write_distances(i, view_.position(leaf_of(position), lane_of(position)), memory.distances);
    }
    if (!receiver.done(row)) return false;
  }
  return true;
}

}  // namespace meshhood
