// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/search.h"

#include "pool.h"

namespace meshhood::python {

/// The answer to one query. `distances` is empty unless requested.
struct Answer {
  std::vector<VertexId> ids;
  std::vector<double> distances;
};

/// A method of the core with what it borrows. Any number of threads may use it at the same time. Each call is made with
/// the interpreter lock, which is released while the call works. Throws as the C++ calls of the same names.
class Method {
 public:
  /// `owner` owns what `method` borrows.
  Method(const SearchMethod& method, std::shared_ptr<const void> owner) : owner_(std::move(owner)), method_(method) {}
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  Answer neighborhood(VertexId v, double radius, bool distances);
  std::size_t count(VertexId v, double radius);
  [[nodiscard]] std::vector<std::uint64_t> neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                                         const BatchOptions& options, const Run& run) const;
  [[nodiscard]] std::vector<std::uint64_t> counts(const BatchQuery& query, const Run& run) const;

 private:
  template <class F>
  auto with_searcher(F&& f) {
    return searchers_.with([this] { return method_.make_searcher(); },
                           [&](AnySearcher& searcher) { return std::visit(f, searcher); });
  }

  std::shared_ptr<const void> owner_;
  SearchMethod method_;
  Pool<AnySearcher> searchers_;
};

/// The exact neighborhood by the index, for the calls that only the index has.
class ExactMethod : public Method {
 public:
  explicit ExactMethod(std::shared_ptr<const Index> index) : Method(*index, index), index_(std::move(index)) {}

  [[nodiscard]] const Index& index() const { return *index_; }

 private:
  std::shared_ptr<const Index> index_;
};

[[nodiscard]] std::shared_ptr<ExactMethod> exact_method(Index index);

/// The approximate neighborhood by the index of the paper.
[[nodiscard]] std::shared_ptr<Method> paper_method(std::shared_ptr<const paper::Index> hierarchy,
                                                   const paper::QueryOptions& options);

/// The neighborhood by another metric.
[[nodiscard]] std::shared_ptr<Method> metric_method(std::shared_ptr<const ExactMethod> exact, Metric metric);

/// Breadth-first search.
[[nodiscard]] std::shared_ptr<Method> bfs_method(std::shared_ptr<const GraphData> graph);

}  // namespace meshhood::python
