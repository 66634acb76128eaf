// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "interpreter.h"
#include "methods.h"
#include "pool.h"

namespace meshhood::python {

/// A method by an index. `Base` is the interface to fill; a `Searcher` asks the `Index`, and the calls for batches are
/// found in its namespace.
template <class Base, class Index, class Searcher>
class IndexMethod : public Base {
 public:
  explicit IndexMethod(Index index) : index_(std::move(index)) {}

  Answer neighborhood(VertexId v, double radius, bool distances) override {
    return ask([&](Searcher& searcher) {
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
    return ask([&](Searcher& searcher) { return searcher.count(v, radius); });
  }

  std::vector<std::uint64_t> neighborhoods(const BatchQuery& query, const BatchAllocator& allocate,
                                           const BatchOptions& options) override {
    using meshhood::neighborhoods;
    return without_lock([&] { return neighborhoods(index_, query, allocate, options); });
  }

  std::vector<std::uint64_t> neighborhood_sizes(const BatchQuery& query, const BatchOptions& options) override {
    using meshhood::neighborhood_sizes;
    return without_lock([&] { return neighborhood_sizes(index_, query, options); });
  }

 protected:
  template <class F>
  auto ask(F&& f) {
    return searchers_.with([&] { return Searcher(index_); }, std::forward<F>(f));
  }

  [[nodiscard]] const Index& built() const { return index_; }

 private:
  Index index_;
  Pool<Searcher> searchers_;
};

}  // namespace meshhood::python
