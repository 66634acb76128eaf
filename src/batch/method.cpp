// SPDX-License-Identifier: MIT
// Makes the factory of each method from its searcher.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/error.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/search/vertex_bfs.h"
#include "paper/hierarchy.h"

namespace meshhood::inline v0_1 {
namespace {

static_assert(NeighborhoodSearcher<Searcher>);
static_assert(NeighborhoodSearcher<paper::Searcher>);
static_assert(NeighborhoodSearcher<ReferenceSearcher>);
static_assert(NeighborhoodSearcher<BallSearcher>);

/// Answers rows one by one, by a searcher of any order.
class SingleRows final : public RowSearch {
 public:
  explicit SingleRows(AnySearcher searcher) : searcher_(std::move(searcher)) {}

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool /*distances*/) const override { return false; }

  [[nodiscard]] bool run(std::span<const RowRun> runs) override {
    item_ = runs.front().items.front();
    return true;
  }

  [[nodiscard]] const PerLane<std::uint64_t>& counts() override {
    counts_[0] = std::visit([&](auto& searcher) { return searcher.count(item_.vertex, item_.radius); }, searcher_);
    return counts_;
  }

  [[nodiscard]] QueryWord queries() const override { return 1; }

  /// Is never called, because packets are those of an index.
  [[nodiscard]] std::span<const Piece> pieces(bool /*in_order*/) override { return {}; }

  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return false; }

  bool write(std::span<const BatchItem> /*items*/, bool distances, RowReceiver& receiver) override {
    const auto find = [&](auto& searcher) {
      if (distances) return searcher.neighborhood(item_.vertex, item_.radius, ids_, distances_);
      searcher.neighborhood(item_.vertex, item_.radius, ids_);
    };
    std::visit(find, searcher_);
    const BatchMemory memory = receiver.memory(item_.row, ids_.size());
    std::copy(ids_.begin(), ids_.end(), memory.ids.begin());
    if (distances) std::copy(distances_.begin(), distances_.end(), memory.distances.begin());
    return receiver.done(item_.row);
  }

 private:
  AnySearcher searcher_;
  BatchItem item_{};  // of the last run
  PerLane<std::uint64_t> counts_{};
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

std::uint32_t position_in_paper_index(const paper::Index& index, VertexId v) {
  return std::visit([v](const auto& hierarchy) { return static_cast<std::uint32_t>(hierarchy.lowest_cluster[v]); },
                    paper::IndexAccess::hierarchy(index));
}

std::unique_ptr<RowSearch> make_rows(const Index& index, Metric metric) {
  switch (metric) {
    case Metric::Path: return make_path_rows(index);
    case Metric::Rings: return make_ring_rows(index);
    case Metric::Straight:
    case Metric::Space: break;
  }
  return make_straight_rows(index, metric);
}

/// The index must outlive all that use it.
SearcherFactory exact_factory(const Index& index, Metric metric) {
  return {.vertex_count = index.vertex_count(),
          .make_searcher = [&index, metric] { return Searcher(index, metric); },
          .position = [&index](VertexId v) { return IndexAccess::view(index).slot[v]; },
          .of_slots = &index,
          .is_count_cheap = true,
          .positions_together = metric == Metric::Straight ? kGroupPositions : kLeafCapacity,
          .make_rows = [&index, metric] { return make_rows(index, metric); }};
}

/// Makes the factory of a method that answers rows one by one.
SearcherFactory single_factory(std::size_t vertices, const std::function<AnySearcher()>& make_searcher,
                               std::function<std::uint32_t(VertexId v)> position, bool is_count_cheap = false) {
  return {.vertex_count = vertices,
          .make_searcher = make_searcher,
          .position = std::move(position),
          .is_count_cheap = is_count_cheap,
          .make_rows = [make_searcher] { return std::make_unique<SingleRows>(make_searcher()); }};
}

constexpr auto kOwnOrder = [](VertexId v) { return std::uint32_t{v}; };

}  // namespace

SearchMethod::SearchMethod(SearcherFactory&& factory)
    : factory_(std::make_shared<const SearcherFactory>(std::move(factory))) {}

SearchMethod::SearchMethod(const Index& index) : SearchMethod(exact_factory(index, Metric::Straight)) {}

SearchMethod::SearchMethod(const paper::Index& index, const paper::QueryOptions& options)
    : SearchMethod(single_factory(
          index.vertex_count(), [&index, options] { return paper::Searcher(index, options); },
          [&index](VertexId v) { return position_in_paper_index(index, v); }, true)) {
  paper::validate(options);
}

SearchMethod SearchMethod::breadth_first(const GraphView& graph) {
  validate(graph);
  return SearchMethod(single_factory(graph.positions.size(), [graph] { return ReferenceSearcher(graph); }, kOwnOrder));
}

SearchMethod SearchMethod::by(Metric metric) const {
  if (factory_->of_slots == nullptr) {
    if (metric == Metric::Straight) return *this;
    raise(ErrorCode::InvalidOption, "metric: expected Straight, because the method is not the exact one of an Index");
  }
  return SearchMethod(exact_factory(*factory_->of_slots, metric));
}

SearchMethod SearchMethod::ball_scan(const PositionsView& positions) {
  return SearchMethod(single_factory(positions.size(), [positions] { return BallSearcher(positions); }, kOwnOrder));
}

std::size_t SearchMethod::vertex_count() const { return factory_->vertex_count; }

AnySearcher SearchMethod::make_searcher() const { return factory_->make_searcher(); }

}  // namespace meshhood::inline v0_1
