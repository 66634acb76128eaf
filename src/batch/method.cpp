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
#include "meshhood/edge_search.h"
#include "meshhood/error.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "batch/filter_copy.h"
#include "batch/path_rows.h"
#include "batch/ring_rows.h"
#include "batch/searcher_factory.h"
#include "batch/straight_rows.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/filtered.h"
#include "exact/query/space_search.h"
#include "exact/search/vertex_bfs.h"
#include "paper/hierarchy.h"

namespace meshhood {
namespace {

/// `EdgeSearcher` with the same filter in all of its calls.
class RestrictedEdges {
 public:
  RestrictedEdges(const Index& index, std::shared_ptr<const FilterCopy> filter)
      : searcher_(index), filter_(std::move(filter)) {}

  [[nodiscard]] std::size_t vertex_count() const { return searcher_.vertex_count(); }
  [[nodiscard]] std::span<const VertexId> permutation() const { return searcher_.permutation(); }
  [[nodiscard]] std::vector<VertexId> neighborhood(VertexId v, double radius) {
    return searcher_.neighborhood(v, radius, filter_->view());
  }
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
    searcher_.neighborhood(v, radius, out, filter_->view());
  }
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
    searcher_.neighborhood(v, radius, out, distances, filter_->view());
  }
  [[nodiscard]] std::size_t count(VertexId v, double radius) { return searcher_.count(v, radius, filter_->view()); }
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius) {
    return searcher_.ranges(v, radius, filter_->view());
  }

 private:
  EdgeSearcher searcher_;
  std::shared_ptr<const FilterCopy> filter_;
};

static_assert(NeighborhoodSearcher<Searcher>);
static_assert(NeighborhoodSearcher<paper::Searcher>);
static_assert(NeighborhoodSearcher<ReferenceSearcher>);
static_assert(NeighborhoodSearcher<BallSearcher>);
static_assert(NeighborhoodSearcher<EdgeSearcher>);
static_assert(NeighborhoodSearcher<RestrictedEdges>);
static_assert(NeighborhoodSearcher<RingSearcher>);
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

/// Does not own the index, which must outlive all that use it.
std::shared_ptr<const Index> borrowed(const Index& index) { return {std::shared_ptr<const void>(), &index}; }

/// That of a method which a filter restricts: takes no other.
std::shared_ptr<const SearcherFactory> without_filters(SearcherFactory factory) {
  factory.with_filter = {};
  return shared(std::move(factory));
}

SearcherFactory exact_factory(const std::shared_ptr<const Index>& index) {
  return {.vertex_count = index->vertex_count(),
          .make_searcher = [index] { return AnySearcher(Searcher(*index)); },
          .position = [index](VertexId v) { return IndexAccess::view(*index).slot[v]; },
          .of_slots = index.get(),
          .is_count_cheap = true,
          .positions_together = StraightRows::kGroupPositions,
          .with_filter =
              [index](const Filter& filter, unsigned threads) {
                return without_filters(exact_factory(std::make_shared<const Index>(filtered(*index, filter, threads))));
              },
          .make_joint_search = [index] { return std::make_unique<StraightRows>(*index); }};
}

SearcherFactory ring_factory(const std::shared_ptr<const Index>& index) {
  return {.vertex_count = index->vertex_count(),
          .make_searcher = [index] { return AnySearcher(RingSearcher(*index)); },
          .position = [index](VertexId v) { return IndexAccess::view(*index).slot[v]; },
          .of_slots = index.get(),
          .is_count_cheap = true,
          .positions_together = kLeafCapacity,
          .with_filter =
              [index](const Filter& filter, unsigned threads) {
                return without_filters(ring_factory(std::make_shared<const Index>(filtered(*index, filter, threads))));
              },
          .make_joint_search = [index] { return std::make_unique<RingRows>(*index); }};
}

/// `filter`: null if there is none.
SearcherFactory edge_factory(const Index& index, const std::shared_ptr<const FilterCopy>& filter) {
  return {.vertex_count = index.vertex_count(),
          .make_searcher =
              [&index, filter] {
                return filter ? AnySearcher(RestrictedEdges(index, filter)) : AnySearcher(EdgeSearcher(index));
              },
          .position = [&index](VertexId v) { return IndexAccess::view(index).slot[v]; },
          .of_slots = &index,
          .is_count_cheap = true,
          .positions_together = kLeafCapacity,
          .with_filter =
              [&index](const Filter& given, unsigned /*threads*/) {
                check_filter(given, index.vertex_count());
                return without_filters(edge_factory(index, std::make_shared<const FilterCopy>(given)));
              },
          .make_joint_search = [&index, filter] { return std::make_unique<PathRows>(index, filter); }};
}

constexpr auto kOwnOrder = [](VertexId v) { return std::uint32_t{v}; };

}  // namespace

std::unique_ptr<BatchWorker> SearcherFactory::make_worker() const {
  return std::make_unique<BatchWorker>(make_joint_search ? make_joint_search()
                                                         : std::make_unique<SingleRows>(make_searcher()));
}

std::shared_ptr<const SearcherFactory> SearcherFactory::restricted(const Filter& filter, unsigned threads) const {
  if (with_filter) return with_filter(filter, threads);
  raise(
      ErrorCode::InvalidOption,
      "this method takes no walls and no ignored vertices, expected the exact index, paths along its edges, or rings, "
      "without any so far");
}

SearchMethod::SearchMethod(std::shared_ptr<const SearcherFactory> searchers) : searchers_(std::move(searchers)) {}

SearchMethod::SearchMethod(const Index& index) : SearchMethod(shared(exact_factory(borrowed(index)))) {}

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

SearchMethod SearchMethod::along_edges(const Index& index) {
  return SearchMethod(shared(edge_factory(index, nullptr)));
}

SearchMethod SearchMethod::rings(const Index& index) { return SearchMethod(shared(ring_factory(borrowed(index)))); }

SearchMethod SearchMethod::in_space(const Index& index) {
  return SearchMethod(shared({.vertex_count = index.vertex_count(),
                              .make_searcher = [&index] { return AnySearcher(SpaceSearcher(index)); },
                              .position = [&index](VertexId v) { return IndexAccess::view(index).slot[v]; },
                              .of_slots = &index,
                              .is_count_cheap = true}));
}

SearchMethod SearchMethod::ball_scan(const PositionsView& positions) {
  return SearchMethod(shared({.vertex_count = positions.size(),
                              .make_searcher = [positions] { return AnySearcher(BallSearcher(positions)); },
                              .position = kOwnOrder}));
}

SearchMethod SearchMethod::restricted(const Filter& filter, unsigned threads) const {
  return SearchMethod(searchers_->restricted(filter, threads));
}

std::size_t SearchMethod::vertex_count() const { return searchers_->vertex_count; }

AnySearcher SearchMethod::make_searcher() const { return searchers_->make_searcher(); }

SearchMethod by_metric(const SearchMethod& method, Metric metric) {
  if (metric == Metric::Straight) return method;
  const Index* const index = method.searchers().of_slots;
  if (index == nullptr) raise(ErrorCode::InvalidOption, "metric: expected Straight, because the method is of no Index");
  return metric == Metric::Path ? SearchMethod::along_edges(*index) : SearchMethod::rings(*index);
}

}  // namespace meshhood
