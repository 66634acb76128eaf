// SPDX-License-Identifier: MIT
#include "methods.h"

#include <memory>
#include <utility>
#include <vector>

#include "interpreter.h"

namespace meshhood::python {

Answer Method::neighborhood(VertexId v, double radius, bool distances) {
  return with_searcher([&](auto& searcher) {
    Answer answer;
    if (distances) {
      searcher.neighborhood(v, radius, answer.ids, answer.distances);
    } else {
      searcher.neighborhood(v, radius, answer.ids);
    }
    return answer;
  });
}

std::size_t Method::count(VertexId v, double radius) {
  return with_searcher([&](auto& searcher) { return searcher.count(v, radius); });
}

std::vector<std::uint64_t> Method::neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                                 const BatchOptions& options, const Run& run) const {
  return without_lock([&] { return meshhood::neighborhoods(method_, query, allocate, options, run); });
}

std::vector<std::uint64_t> Method::counts(const BatchQuery& query, const Run& run) const {
  return without_lock([&] { return meshhood::counts(method_, query, run); });
}

std::shared_ptr<ExactMethod> exact_method(Index index) {
  return std::make_shared<ExactMethod>(std::make_shared<const Index>(std::move(index)));
}

std::shared_ptr<Method> paper_method(std::shared_ptr<const paper::Index> hierarchy,
                                     const paper::QueryOptions& options) {
  const paper::Index& index = *hierarchy;
  return std::make_shared<Method>(SearchMethod(index, options), std::move(hierarchy));
}

std::shared_ptr<Method> metric_method(std::shared_ptr<const ExactMethod> exact, Metric metric) {
  const Index& index = exact->index();
  return std::make_shared<Method>(SearchMethod(index).by(metric), std::move(exact));
}

std::shared_ptr<Method> bfs_method(std::shared_ptr<const GraphData> graph) {
  const GraphView view = graph->view();
  return std::make_shared<Method>(without_lock([&] { return SearchMethod::breadth_first(view); }), std::move(graph));
}

}  // namespace meshhood::python
