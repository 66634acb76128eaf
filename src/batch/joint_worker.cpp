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

void JointWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) {
  for_each_run(chunk, [&](const Run& run) {
    if (kept != nullptr) {
      const std::span<const Piece> pieces = answer(run);
      const auto counts = std::span(counts_of(run)).first(run.items.size());
      kept->add(pieces, counts);
      return sink(run.items, counts);
    }
    if (run.is_joint) {
      search_together(run);
      return sink(run.items, std::span(joint_->counts()).first(run.items.size()));
    }
    const std::uint64_t size = searcher().count(run.items.front().vertex, run.items.front().radius);
    return sink(run.items, {&size, 1});
  });
}

void JointWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                       KeptPackets::Reader* kept) {
  for_each_run(chunk, [&](const Run& run) {
    const bool is_kept = kept != nullptr && kept->next();
    writer_.begin(is_kept ? kept->pieces() : answer(run));
    return write(run.items, is_kept ? kept->counts() : counts_of(run), distances, receiver);
  });
}

void JointWorker::visit(std::span<const BatchItem> chunk, const std::function<bool(const PacketAnswer&)>& sink) {
  for_each_run(chunk, [&](const Run& run) {
    const std::span<const Piece> pieces = answer(run);
    lists_.assign(run.items);
    const QueryWord queries = run.is_joint ? joint_->queries() : 1;
    return sink({lists_.rows, lists_.vertices, lists_.radii, queries, pieces});
  });
}

/// Calls `f(run)` for the runs of a chunk, until it returns false.
template <class F>
void JointWorker::for_each_run(std::span<const BatchItem> chunk, F&& f) {
  split(chunk);
  for (const Run& run : runs_) {
    if (!f(run)) return;
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
    if (pays(leaf, size, chunk.front().radius)) {
      runs_.push_back({leaf, chunk.first(size), true});
    } else {
      for (std::size_t i = 0; i < size; ++i) runs_.push_back({leaf, chunk.subspan(i, 1), false});
    }
    chunk = chunk.subspan(size);
  }
}

/// The neighborhoods of a run. Valid until the next search.
std::span<const Piece> JointWorker::answer(const Run& run) {
  if (run.is_joint) {
    search_together(run);
    return joint_->pieces();
  }
  return single_packet_.describe(view_, search_single(run.items.front()));
}

/// The sizes of the rows of a run, after `answer`.
const PerLane<std::uint64_t>& JointWorker::counts_of(const Run& run) {
  return run.is_joint ? joint_->counts() : single_packet_.counts();
}

bool JointWorker::write(std::span<const BatchItem> items, const PerLane<std::uint64_t>& counts, bool distances,
                        RowReceiver& receiver) {
  for (unsigned i = 0; i < items.size(); ++i) {
    const BatchMemory memory = receiver.memory(items[i].row, counts[i]);
    writer_.write_ids(i, memory.ids);
    if (distances) writer_.write_distances(i, position_of(items[i]), memory.distances);
    if (!receiver.done(items[i].row)) return false;
  }
  return true;
}

/// `run` is one of `runs_`.
void JointWorker::search_together(const Run& run) {
  if (leaves_.empty() || leaves_.front() / kFanOut != group_of(run)) {
    const std::span<const Run> rest(&run, runs_.data() + runs_.size());
    begin_group({rest.begin(), std::ranges::find_if(rest, [&](const Run& r) { return group_of(r) != group_of(run); })});
  }
  queries_.clear();
  for (const BatchItem& item : run.items) queries_.push_back({lane_of(item.position), prepared(item.radius)});
  joint_->run(run.leaf, queries_);
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
