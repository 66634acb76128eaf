// SPDX-License-Identifier: MIT
#include "methods.h"

#include <memory>
#include <utility>
#include <vector>

#include "meshhood/edge_search.h"
#include "meshhood/reference.h"

#include "searcher_method.h"

namespace meshhood::python {
namespace {

struct ExactSource {
  Index index;

  [[nodiscard]] Searcher searcher() const { return Searcher(index); }
  [[nodiscard]] SearchMethod method() const { return {index}; }
};

struct PaperSource {
  std::shared_ptr<const paper::Index> hierarchy;
  paper::QueryOptions options;

  [[nodiscard]] paper::Searcher searcher() const { return paper::Searcher(*hierarchy, options); }
  [[nodiscard]] SearchMethod method() const { return {*hierarchy, options}; }
};

struct EdgeSource {
  std::shared_ptr<const ExactMethod> exact;

  [[nodiscard]] EdgeSearcher searcher() const { return EdgeSearcher(exact->index()); }
  [[nodiscard]] SearchMethod method() const { return SearchMethod::along_edges(exact->index()); }
};

struct BfsSource {
  std::shared_ptr<const GraphData> graph;

  [[nodiscard]] ReferenceSearcher searcher() const { return ReferenceSearcher(graph->view()); }
  [[nodiscard]] SearchMethod method() const { return SearchMethod::breadth_first(graph->view()); }
};

struct BallSource {
  std::shared_ptr<const GraphData> graph;

  [[nodiscard]] BallSearcher searcher() const { return BallSearcher(graph->view().positions); }
  [[nodiscard]] SearchMethod method() const { return SearchMethod::ball_scan(graph->view().positions); }
};

class IndexedExactMethod : public SearcherMethod<ExactMethod, ExactSource> {
 public:
  using SearcherMethod::SearcherMethod;

  [[nodiscard]] const Index& index() const override { return source().index; }

  std::vector<VertexRange> ranges(VertexId v, double radius) override {
    return with_searcher([&](Searcher& searcher) {
      const auto ranges = searcher.ranges(v, radius);
      return std::vector(ranges.begin(), ranges.end());
    });
  }
};

}  // namespace

std::shared_ptr<ExactMethod> exact_method(Index index) {
  return std::make_shared<IndexedExactMethod>(ExactSource{std::move(index)});
}

std::shared_ptr<Method> paper_method(std::shared_ptr<const paper::Index> hierarchy,
                                     const paper::QueryOptions& options) {
  return std::make_shared<SearcherMethod<Method, PaperSource>>(PaperSource{std::move(hierarchy), options});
}

std::shared_ptr<Method> edge_method(std::shared_ptr<const ExactMethod> exact) {
  return std::make_shared<SearcherMethod<Method, EdgeSource>>(EdgeSource{std::move(exact)});
}

std::shared_ptr<Method> bfs_method(std::shared_ptr<const GraphData> graph) {
  return std::make_shared<SearcherMethod<Method, BfsSource>>(BfsSource{std::move(graph)});
}

std::shared_ptr<Method> ball_method(std::shared_ptr<const GraphData> graph) {
  return std::make_shared<SearcherMethod<Method, BallSource>>(BallSource{std::move(graph)});
}

}  // namespace meshhood::python
