// SPDX-License-Identifier: MIT
#include "batch/joint_worker.h"

#include <algorithm>

#include "exact/index_access.h"
#include "exact/search/searcher_state.h"

namespace meshhood {
namespace {

// A packet costs about as much as this many rows of a leaf that are answered one by one with vectors (docs/joint.md).
// With the portable kernels, it costs as much as more rows; but which rows are answered together must not depend on the
// processor, because sums over packets do.
constexpr std::size_t kBreakEven = 8;
constexpr std::size_t kBreakEvenOfLarge = 12;  // where the radius is large
constexpr double kLargeRadius = 5;             // in mean leaf radii

}  // namespace

JointWorker::JointWorker(const Index& index, Isa isa)
    : index_(index),
      view_(IndexAccess::view(index)),
      isa_(isa),
      radius_(view_.frame, 0),
      unlike_a_surface_(is_unlike_a_surface(view_)),
      writer_(view_, isa) {}

void JointWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink) {
  for_each_run(
      chunk, [&](const Run& run) { return sink(run.items, std::span(joint_->counts()).first(run.items.size())); },
      [&](const BatchItem& item) {
        const std::uint64_t size = searcher().count(item.vertex, item.radius);
        return sink({&item, 1}, {&size, 1});
      });
}

void JointWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver) {
  const auto write = [&](const PacketAnswer& answer, const PerLane<std::uint64_t>& counts,
                         std::span<const BatchItem> items) {
    writer_.begin(answer);
    for (unsigned i = 0; i < items.size(); ++i) {
      const BatchMemory memory = receiver.memory(items[i].row, counts[i]);
      writer_.write_ids(i, memory.ids);
      if (distances) writer_.write_distances(i, position_of(items[i]), memory.distances);
      if (!receiver.done(items[i].row)) return false;
    }
    return true;
  };
  for_each_run(
      chunk, [&](const Run& run) { return write(joint_->answer(), joint_->counts(), run.items); },
      [&](const BatchItem& item) {
        const VertexSet& found = search_single(item);
        return write(single_packet_.describe(view_, found), {found.count()}, {&item, 1});
      });
}

void JointWorker::visit(std::span<const BatchItem> chunk, const std::function<bool(const PacketAnswer&)>& sink) {
  LeafId group = 0;
  bool has_group = false;
  const auto pass_on = [&](PacketAnswer answer, bool begins_group) {
    answer.rows = lists_.rows;
    answer.vertices = lists_.vertices;
    answer.radii = lists_.radii;
    answer.begins_group = begins_group;
    return sink(answer);
  };
  for_each_run(
      chunk,
      [&](const Run& run) {
        const bool begins_group = !has_group || run.leaf / kFanOut != group;
        has_group = true;
        group = run.leaf / kFanOut;
        lists_.assign(run.items);
        return pass_on(joint_->answer(), begins_group);
      },
      [&](const BatchItem& item) {
        has_group = false;
        lists_.assign({&item, 1});
        return pass_on(single_packet_.describe(view_, search_single(item)), true);
      });
}

/// Calls `together(run)` for each packet once its search is done, and `single(item)` for the other rows, until one of
/// them returns false.
template <class Together, class Single>
void JointWorker::for_each_run(std::span<const BatchItem> chunk, Together&& together, Single&& single) {
  split(chunk);
  const auto group_of = [](const Run& run) { return run.leaf / kFanOut; };
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (!runs_[i].is_joint) {
      for (const BatchItem& item : runs_[i].items) {
        if (!single(item)) return;
      }
      continue;
    }
    if (leaves_.empty() || leaves_.front() / kFanOut != group_of(runs_[i])) {
      std::size_t end = i;
      while (end < runs_.size() && group_of(runs_[end]) == group_of(runs_[i])) ++end;
      begin_group(std::span(runs_).subspan(i, end - i));
    }
    begin_packet(runs_[i]);
    if (!together(runs_[i])) return;
  }
}

/// Cuts a chunk, whose vertices ascend in index order, into runs.
void JointWorker::split(std::span<const BatchItem> chunk) {
  runs_.clear();
  leaves_.clear();
  while (!chunk.empty()) {
    const LeafId leaf = leaf_of(chunk.front().position);
    const std::size_t most = std::min<std::size_t>(chunk.size(), kPacketCapacity);
    std::size_t size = 1;
    while (size < most && leaf_of(chunk[size].position) == leaf) ++size;
    runs_.push_back({leaf, chunk.first(size), pays(leaf, size, chunk.front().radius)});
    chunk = chunk.subspan(size);
  }
}

void JointWorker::begin_group(std::span<const Run> runs) {
  leaves_.clear();
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const Run& run : runs) {
    if (!run.is_joint) continue;
    if (leaves_.empty() || leaves_.back() != run.leaf) leaves_.push_back(run.leaf);
    for (const BatchItem& item : run.items) {
      low = std::min(low, item.radius);
      high = std::max(high, item.radius);
    }
  }
  if (!joint_) joint_.emplace(view_, isa_);
  const TreeBounds low_bounds = prepared(low).bounds;
  joint_->begin_group(leaves_, low_bounds, prepared(high).bounds);
}

void JointWorker::begin_packet(const Run& run) {
  queries_.clear();
  for (const BatchItem& item : run.items) queries_.push_back({lane_of(item.position), prepared(item.radius)});
  joint_->run(run.leaf, queries_);
}

/// Whether to answer `size` vertices of a leaf together.
bool JointWorker::pays(LeafId leaf, std::size_t size, double radius) const {
  if (unlike_a_surface_) return false;  // few vertices of a leaf have the same neighbors
  const bool is_large = radius > kLargeRadius * view_.tree.front().mean_radius / view_.frame.scale;
  // If all vertices of a small leaf are queried, then mostly all vertices of its group are.
  if (is_large && size == view_.leaves[leaf].size) return true;
  return size >= (is_large ? kBreakEvenOfLarge : kBreakEven);
}

const JointRadius& JointWorker::prepared(double radius) {
  if (radius != radius_.radius) radius_ = JointRadius(view_.frame, radius);
  return radius_;
}

const VertexSet& JointWorker::search_single(const BatchItem& item) {
  SearcherAccess::State& state = SearcherAccess::state(searcher());
  state.search(item.vertex, item.radius);
  if (state.way == SearcherAccess::State::Way::VertexBfs) state.answer.align_to_leaves();
  return state.answer;
}

Point JointWorker::position_of(const BatchItem& item) const {
  return view_.position(leaf_of(item.position), lane_of(item.position));
}

Searcher& JointWorker::searcher() {
  if (!searcher_) searcher_.emplace(index_);
  return *searcher_;
}

}  // namespace meshhood
