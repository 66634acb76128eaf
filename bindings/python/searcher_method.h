// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "meshhood/batch.h"

#include "interpreter.h"
#include "methods.h"
#include "pool.h"

namespace meshhood::python {

/// A method whose `Source` has `searcher()`, which makes a searcher, and `method()`, which is the same for batches.
/// `Base` is the interface to implement.
template <class Base, class Source>
class SearcherMethod : public Base {
 public:
  using Searcher = decltype(std::declval<const Source&>().searcher());

  explicit SearcherMethod(Source source) : source_(std::move(source)) {}

  Answer neighborhood(VertexId v, double radius, bool distances) override {
    return with_searcher([&](Searcher& searcher) {
      Answer answer;
      if (distances) {
        searcher.neighborhood(v, radius, answer.ids, answer.distances);
      } else {
        searcher.neighborhood(v, radius, answer.ids);
      }
      return answer;
    });
  }

  std::size_t count(VertexId v, double radius) override {
    return with_searcher([&](Searcher& searcher) { return searcher.count(v, radius); });
  }

  std::vector<std::uint64_t> neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                           const BatchOptions& options) override {
    return without_lock([&] { return meshhood::neighborhoods(source_.method(), query, allocate, options); });
  }

  std::vector<std::uint64_t> neighborhood_sizes(const BatchQuery& query, const BatchOptions& options) override {
    return without_lock([&] { return meshhood::neighborhood_sizes(source_.method(), query, options); });
  }

 protected:
  template <class F>
  auto with_searcher(F&& f) {
    return searchers_.with([&] { return source_.searcher(); }, std::forward<F>(f));
  }

  [[nodiscard]] const Source& source() const { return source_; }

 private:
  Source source_;
  Pool<Searcher> searchers_;
};

}  // namespace meshhood::python
