// SPDX-License-Identifier: MIT
// The methods, each by its searcher.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/error.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "batch/path_rows.h"
#include "batch/ring_rows.h"
#include "batch/searcher_factory.h"
#include "batch/straight_rows.h"
#include "exact/index_access.h"
#include "exact/query/space_search.h"
#include "exact/search/vertex_bfs.h"
#include "paper/hierarchy.h"

namespace meshhood {
namespace {

static_assert(NeighborhoodSearcher<Searcher>);
static_assert(NeighborhoodSearcher<paper::Searcher>);
static_assert(NeighborhoodSearcher<ReferenceSearcher>);
static_assert(NeighborhoodSearcher<BallSearcher>);
static_assert(NeighborhoodSearcher<SpaceSearcher>);
static_assert(NeighborhoodSearcher<AnySearcher>);

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
    counts_[0] = searcher_.count(item_.vertex, item_.radius);
    return counts_;
  }

  [[nodiscard]] QueryWord queries() const override { return 1; }

  [[nodiscard]] std::span<const Piece> pieces() override {
    raise(ErrorCode::InvalidOption, "this method has no packets, expected the exact index, paths or rings");
  }

  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return false; }

  bool write(std::span<const BatchItem> /*items*/, const RowAnswers& /*answers*/, bool distances,
             RowReceiver& receiver) override {
    if (distances) {
      searcher_.neighborhood(item_.vertex, item_.radius, ids_, distances_);
    } else {
      searcher_.neighborhood(item_.vertex, item_.radius, ids_);
    }
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

std::shared_ptr<const SearcherFactory> shared(SearcherFactory factory) {
  return std::make_shared<const SearcherFactory>(std::move(factory));
}

std::uint32_t position_in_paper_index(const paper::Index& index, VertexId v) {
  return std::visit([v](const auto& hierarchy) { return static_cast<std::uint32_t>(hierarchy.lowest_cluster[v]); },
                    paper::IndexAccess::hierarchy(index));
}

/// What the metrics have in common. The index must outlive all that use it.
SearcherFactory factory_of(const Index& index) {
  return {.vertex_count = index.vertex_count(),
          .make_searcher = {},
          .position = [&index](VertexId v) { return IndexAccess::view(index).slot[v]; },
          .of_slots = &index,
          .is_count_cheap = true,
          .positions_together = kLeafCapacity};
}

std::unique_ptr<RowSearch> make_rows(const Index& index, Metric metric) {
  switch (metric) {
    case Metric::Path: return std::make_unique<PathRows>(index);
    case Metric::Rings: return std::make_unique<RingRows>(index);
    case Metric::Straight: break;
  }
  return std::make_unique<StraightRows>(index);
}

SearcherFactory exact_factory(const Index& index, Metric metric) {
  SearcherFactory factory = factory_of(index);
  factory.has_metrics = true;
  factory.make_searcher = [&index, metric] { return AnySearcher(Searcher(index, metric)); };
  if (metric == Metric::Straight) factory.positions_together = StraightRows::kGroupPositions;
  factory.make_joint_search = [&index, metric] { return make_rows(index, metric); };
  return factory;
}

constexpr auto kOwnOrder = [](VertexId v) { return std::uint32_t{v}; };

}  // namespace

std::unique_ptr<BatchWorker> SearcherFactory::make_worker() const {
  return std::make_unique<BatchWorker>(make_joint_search ? make_joint_search()
                                                         : std::make_unique<SingleRows>(make_searcher()));
}

SearchMethod::SearchMethod(std::shared_ptr<const SearcherFactory> searchers) : searchers_(std::move(searchers)) {}

SearchMethod::SearchMethod(const Index& index) : SearchMethod(shared(exact_factory(index, Metric::Straight))) {}

SearchMethod::SearchMethod(const paper::Index& index, const paper::QueryOptions& options)
    : SearchMethod(shared({.vertex_count = index.vertex_count(),
                           .make_searcher = [&index, options] { return AnySearcher(paper::Searcher(index, options)); },
                           .position = [&index](VertexId v) { return position_in_paper_index(index, v); },
                           .is_count_cheap = true})) {
  paper::validate(options);
}

SearchMethod SearchMethod::breadth_first(const GraphView& graph) {
  validate(graph);
  return SearchMethod(shared({.vertex_count = graph.positions.size(),
                              .make_searcher = [graph] { return AnySearcher(ReferenceSearcher(graph)); },
                              .position = kOwnOrder}));
}

SearchMethod SearchMethod::by(Metric metric) const {
  if (!searchers_->has_metrics) {
    if (metric == Metric::Straight) return *this;
    raise(ErrorCode::InvalidOption, "metric: expected Straight, because the method is not the exact one of an Index");
  }
  return SearchMethod(shared(exact_factory(*searchers_->of_slots, metric)));
}

SearchMethod SearchMethod::in_space(const Index& index) {
  const IndexView& view = IndexAccess::view(index);
  if (!view.walls.empty() || !view.ignored.empty()) {
    raise(ErrorCode::InvalidOption, "the ball in space has no masks, expected an index without");
  }
  SearcherFactory factory = factory_of(index);
  factory.make_searcher = [&index] { return AnySearcher(SpaceSearcher(index)); };
  factory.positions_together = 1;
  return SearchMethod(shared(std::move(factory)));
}

SearchMethod SearchMethod::ball_scan(const PositionsView& positions) {
  return SearchMethod(shared({.vertex_count = positions.size(),
                              .make_searcher = [positions] { return AnySearcher(BallSearcher(positions)); },
                              .position = kOwnOrder}));
}

std::size_t SearchMethod::vertex_count() const { return searchers_->vertex_count; }

AnySearcher SearchMethod::make_searcher() const { return searchers_->make_searcher(); }

}  // namespace meshhood
