// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "batch/row_search.h"
#include "exact/joint/joint_search.h"
#include "exact/joint/row_writer.h"
#include "exact/layout.h"
#include "exact/query/space_search.h"
#include "exact/search/straight_search.h"
#include "exact/vertex_set.h"

namespace meshhood {

/// The rows of straight lines. Neighborhoods: the joint search for many rows of a leaf, and a single search for others.
/// In space, each row alone. The index must outlive it.
class StraightRows final : public RowSearch {
 public:
  /// The positions of a group: rows that lie between two multiples of it should come in one chunk.
  static constexpr std::uint32_t kGroupPositions = kFanOut * kLeafCapacity;

  explicit StraightRows(const Index& index, Metric metric = Metric::Straight, Isa isa = best_isa());

  void begin_chunk() override { leaves_.clear(); }
  [[nodiscard]] bool pays(std::span<const BatchItem> items, bool distances) const override;
  [[nodiscard]] bool run(std::span<const RowRun> runs) override;
  [[nodiscard]] const PerLane<std::uint64_t>& counts() override;
  [[nodiscard]] QueryWord queries() const override { return is_joint_ ? joint_->queries() : 1; }
  [[nodiscard]] std::span<const Piece> pieces() override;
  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return true; }
  bool write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
             RowReceiver& receiver) override;

 private:
  void begin_group(std::span<const RowRun> runs);
  [[nodiscard]] VertexSet& search(VertexId v, double radius);
  [[nodiscard]] const JointRadius& prepared(double radius);
  [[nodiscard]] std::span<const Piece> pieces_of(VertexSet& found);

  const Index& index_;
  const IndexView& view_;
  Metric metric_;
  Isa isa_;
  bool is_single_;  // each row is answered alone: unlike on a surface, few vertices of a leaf have the same neighbors
  JointRadius radius_;  // of the last row, because most batches have one radius
  RowWriter writer_;
  // Made by the first run that needs them:
  std::optional<StraightSearch> single_;
  std::optional<SpaceSearch> space_;
  std::optional<JointSearch> joint_;
  // Of the last run:
  bool is_joint_ = false;
  VertexSet* found_ = nullptr;  // of a single row
  std::vector<LeafId> leaves_;  // of its group; none at the begin of a chunk
  std::vector<JointQuery> queries_;
  PerLane<std::uint64_t> counts_{};
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> words_;
};

}  // namespace meshhood
