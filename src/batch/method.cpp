// SPDX-License-Identifier: MIT
// The methods that a batch can use, each by its searcher.
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>

#include "meshhood/batch.h"
#include "meshhood/edge_search.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "batch/joint_worker.h"
#include "batch/searcher_factory.h"
#include "exact/index_access.h"
#include "paper/index_access.h"

namespace meshhood {
namespace {

static_assert(NeighborhoodSearcher<Searcher>);
static_assert(NeighborhoodSearcher<paper::Searcher>);
static_assert(NeighborhoodSearcher<ReferenceSearcher>);
static_assert(NeighborhoodSearcher<BallSearcher>);
static_assert(NeighborhoodSearcher<EdgeSearcher>);

constexpr auto kNothing = [](auto&) {};

template <NeighborhoodSearcher S, class Begin>
std::unique_ptr<BatchWorker> worker_of(S searcher, Begin begin) {
  return std::make_unique<SearcherWorker<S, Begin>>(std::move(searcher), begin);
}

template <class Make, class Position>
std::shared_ptr<const SearcherFactory> factory_of(std::size_t vertex_count, const MethodTraits& traits, Make make,
                                                  Position position) {
  return std::make_shared<const FactoryOf<Make, Position>>(vertex_count, traits, std::move(make), std::move(position));
}

std::uint32_t position_in_paper_index(const paper::Index& index, VertexId v) {
  return std::visit([v](const auto& hierarchy) { return static_cast<std::uint32_t>(hierarchy.lowest_cluster[v]); },
                    paper::IndexAccess::hierarchy(index));
}

constexpr auto kOwnOrder = [](VertexId v) { return std::uint32_t{v}; };

}  // namespace

SearchMethod::SearchMethod(std::shared_ptr<const SearcherFactory> searchers) : searchers_(std::move(searchers)) {}

SearchMethod::SearchMethod(const Index& index)
    : SearchMethod(factory_of(
          index.vertex_count(), {.is_count_cheap = true, .positions_together = JointWorker::kGroupPositions},
          [&index] { return std::make_unique<JointWorker>(index); },
          [&index](VertexId v) { return IndexAccess::view(index).slot[v]; })) {}

SearchMethod::SearchMethod(const paper::Index& index, const paper::QueryOptions& options)
    : SearchMethod(factory_of(
          index.vertex_count(), {.is_count_cheap = true},
          [&index, options] { return worker_of(paper::Searcher(index, options), kNothing); },
          [&index](VertexId v) { return position_in_paper_index(index, v); })) {
  paper::validate(options);
}

SearchMethod SearchMethod::breadth_first(const GraphView& graph) {
  validate(graph);
  return SearchMethod(factory_of(
      graph.positions.size(), {.is_count_cheap = false},
      [graph] { return worker_of(ReferenceSearcher(graph), kNothing); }, kOwnOrder));
}

SearchMethod SearchMethod::along_edges(const Index& index) {
  return SearchMethod(factory_of(
      index.vertex_count(), {.is_count_cheap = false}, [&index] { return worker_of(EdgeSearcher(index), kNothing); },
      [&index](VertexId v) { return IndexAccess::view(index).slot[v]; }));
}

SearchMethod SearchMethod::ball_scan(const PositionsView& positions) {
  return SearchMethod(factory_of(
      positions.size(), {.is_count_cheap = false}, [positions] { return worker_of(BallSearcher(positions), kNothing); },
      kOwnOrder));
}

std::size_t SearchMethod::vertex_count() const { return searchers_->vertex_count(); }

}  // namespace meshhood
