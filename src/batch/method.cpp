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
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "batch/filter_copy.h"
#include "batch/joint_worker.h"
#include "batch/path_worker.h"
#include "batch/ring_worker.h"
#include "batch/searcher_factory.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/filtered.h"
#include "exact/query/space_search.h"
#include "paper/hierarchy.h"

namespace meshhood {
namespace {

static_assert(NeighborhoodSearcher<Searcher>);
static_assert(NeighborhoodSearcher<paper::Searcher>);
static_assert(NeighborhoodSearcher<ReferenceSearcher>);
static_assert(NeighborhoodSearcher<BallSearcher>);
static_assert(NeighborhoodSearcher<EdgeSearcher>);
static_assert(NeighborhoodSearcher<RingSearcher>);
static_assert(NeighborhoodSearcher<SpaceSearcher>);
static_assert(NeighborhoodSearcher<AnySearcher>);

/// Answers rows one by one.
class SearcherWorker final : public BatchWorker {
 public:
  explicit SearcherWorker(AnySearcher searcher) : searcher_(std::move(searcher)) {}

  void count(std::span<const BatchItem> chunk, const SizeSink& sink) override {
    for (const BatchItem& item : chunk) {
      const std::uint64_t size = searcher_.count(item.vertex, item.radius);
      if (!sink({&item, 1}, {&size, 1})) return;
    }
  }

  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver) override {
    for (const BatchItem& item : chunk) {
      if (distances) {
        searcher_.neighborhood(item.vertex, item.radius, ids_, distances_);
      } else {
        searcher_.neighborhood(item.vertex, item.radius, ids_);
      }
      const BatchMemory memory = receiver.memory(item.row, ids_.size());
      std::copy(ids_.begin(), ids_.end(), memory.ids.begin());
      if (distances) std::copy(distances_.begin(), distances_.end(), memory.distances.begin());
      if (!receiver.done(item.row)) return;
    }
  }

 private:
  AnySearcher searcher_;
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

SearcherFactory exact_factory(const std::shared_ptr<const Index>& index) {
  return {.vertex_count = index->vertex_count(),
          .make_searcher = [index] { return AnySearcher(Searcher(*index)); },
          .position = [index](VertexId v) { return IndexAccess::view(*index).slot[v]; },
          .is_count_cheap = true,
          .positions_together = JointWorker::kGroupPositions,
          .with_filter =
              [index](const Filter& filter, unsigned threads) {
                return shared(exact_factory(std::make_shared<const Index>(filtered(*index, filter, threads))));
              },
          .make_joint_worker = [index] { return std::make_unique<JointWorker>(*index); }};
}

SearcherFactory ring_factory(const std::shared_ptr<const Index>& index) {
  return {.vertex_count = index->vertex_count(),
          .make_searcher = [index] { return AnySearcher(RingSearcher(*index)); },
          .position = [index](VertexId v) { return IndexAccess::view(*index).slot[v]; },
          .is_count_cheap = true,
          .positions_together = kLeafCapacity,
          .with_filter =
              [index](const Filter& filter, unsigned threads) {
                return shared(ring_factory(std::make_shared<const Index>(filtered(*index, filter, threads))));
              },
          .make_joint_worker = [index] { return std::make_unique<RingWorker>(*index); }};
}

/// `filter`: null if there is none.
SearcherFactory edge_factory(const Index& index, const std::shared_ptr<const FilterCopy>& filter) {
  return {.vertex_count = index.vertex_count(),
          .make_searcher = [&index] { return AnySearcher(EdgeSearcher(index)); },
          .position = [&index](VertexId v) { return IndexAccess::view(index).slot[v]; },
          .is_count_cheap = true,
          .positions_together = kLeafCapacity,
          .with_filter =
              [&index](const Filter& given, unsigned /*threads*/) {
                check_filter(given, index.vertex_count());
                return shared(edge_factory(index, std::make_shared<const FilterCopy>(given)));
              },
          .make_joint_worker = [&index, filter] { return std::make_unique<PathWorker>(index, filter); }};
}

constexpr auto kOwnOrder = [](VertexId v) { return std::uint32_t{v}; };

}  // namespace

std::unique_ptr<BatchWorker> SearcherFactory::make_worker() const {
  return make_joint_worker ? make_joint_worker() : std::make_unique<SearcherWorker>(make_searcher());
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
                              .is_count_cheap = true}));
}

SearchMethod SearchMethod::ball_scan(const PositionsView& positions) {
  return SearchMethod(shared({.vertex_count = positions.size(),
                              .make_searcher = [positions] { return AnySearcher(BallSearcher(positions)); },
                              .position = kOwnOrder}));
}

std::size_t SearchMethod::vertex_count() const { return searchers_->vertex_count; }

AnySearcher SearchMethod::make_searcher() const { return searchers_->make_searcher(); }

}  // namespace meshhood
