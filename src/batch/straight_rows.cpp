// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/joint/joint_search.h"
#include "exact/query/single_queries.h"
#include "exact/search/vertex_bfs.h"
#include "exact/vertex_set.h"

namespace meshhood::inline v0_1 {
namespace {

// A packet costs about as much as this many rows of a leaf that are answered one by one with vectors (docs/joint.md).
// With the portable kernels, it costs as much as more rows; but which rows are answered together must not depend on the
// processor, because sums over packets do.
constexpr std::size_t kBreakEven = 8;
constexpr std::size_t kBreakEvenOfLarge = 12;  // where the radius is large
constexpr double kLargeRadius = 5;             // in mean leaf radii

LeafId leaf_of_run(const RowRun& run) { return leaf_of(run.items.front().position); }
LeafId group_of(const RowRun& run) { return leaf_of_run(run) / kFanOut; }

/// Answers rows by straight lines: many rows of a leaf by the joint search; others, and rows in space, each alone.
class StraightRows final : public RowSearch {
 public:
  StraightRows(const Index& index, Metric metric, Isa isa)
      : index_(index),
        view_(IndexAccess::view(index)),
        metric_(metric),
        isa_(isa),
        is_single_(metric == Metric::Space || is_unlike_a_surface(view_)),
        is_by_vertex_(metric == Metric::Straight && is_odd(view_)),
        radius_(view_.frame, 0) {}

  void begin_chunk() override { leaves_.clear(); }

  [[nodiscard]] bool pays(std::span<const BatchItem> items, bool /*distances*/) const override {
    if (is_single_) return false;
    const BatchItem& first = items.front();
    const bool is_large = first.radius > kLargeRadius * view_.tree.front().mean_radius / view_.frame.scale;
    // If all vertices of a small leaf are queried, then mostly all vertices of its group are.
    if (is_large && items.size() == view_.leaves[leaf_of(first.position)].size) return true;
    return items.size() >= (is_large ? kBreakEvenOfLarge : kBreakEven);
  }

  [[nodiscard]] bool run(std::span<const RowRun> runs) override {
    const auto& [items, is_joint] = runs.front();
    is_joint_ = is_joint;
    if (is_joint) {
      if (leaves_.empty() || leaves_.front() / kFanOut != group_of(runs.front())) begin_group(runs);
      queries_.clear();
      for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), prepared(item.radius)});
      joint_->run(leaf_of_run(runs.front()), queries_);
    } else {
      if (!single_) single_ = make_queries(BoundIndex(index_), IndexAccess::share_graph(index_), metric_, isa_);
      found_ = &single_->search(items.front().vertex, items.front().radius);
    }
    return true;
  }

  [[nodiscard]] const PerLane<std::uint64_t>& counts() override {
    if (is_joint_) return joint_->counts();
    counts_[0] = found_->count();
    return counts_;
  }

  [[nodiscard]] QueryWord queries() const override { return is_joint_ ? joint_->queries() : 1; }
  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return true; }

  [[nodiscard]] std::span<const Piece> pieces(bool in_order) override {
    if (is_joint_) return joint_->pieces(in_order);
    if (is_by_vertex_) found_->align_to_leaves();
    return pieces_of(*found_);
  }

 private:
  /// Begins the group of the first run, with the radii of all its rows.
  void begin_group(std::span<const RowRun> runs) {
    leaves_.clear();
    double low = kInfinity;
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

  [[nodiscard]] const JointRadius& prepared(double radius) {
    if (radius != radius_.radius) radius_ = JointRadius(view_.frame, radius);
    return radius_;
  }

  [[nodiscard]] std::span<const Piece> pieces_of(VertexSet& found) {
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

  const Index& index_;
  const IndexView& view_;
  Metric metric_;
  Isa isa_;
  bool is_single_;  // each row is answered alone: unlike on a surface, few vertices of a leaf have the same neighbors
  bool is_by_vertex_;   // by `VertexBfs`, whose answers are not aligned to leaves
  JointRadius radius_;  // of the last row, because most batches have one radius
  // Made by the first run that needs them:
  std::unique_ptr<SingleQueries> single_;
  std::optional<JointSearch> joint_;
  // The state of the last run.
  bool is_joint_ = false;
  VertexSet* found_ = nullptr;  // of a single row
  std::vector<LeafId> leaves_;  // of its group; none at the begin of a chunk
  std::vector<JointQuery> queries_;
  PerLane<std::uint64_t> counts_{};
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> words_;
};

}  // namespace

std::unique_ptr<RowSearch> make_straight_rows(const Index& index, Metric metric, Isa isa) {
  return std::make_unique<StraightRows>(index, metric, isa);
}

}  // namespace meshhood::inline v0_1
