// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "meshhood/search.h"

#include "methods.h"
#include "pool.h"

namespace meshhood::python {

/// The queries of an index beyond neighborhoods. Any number of threads may use it at the same time. Each call is made
/// with the interpreter lock, which is released while the call works.
class Queries {
 public:
  explicit Queries(std::shared_ptr<const ExactMethod> exact) : exact_(std::move(exact)) {}
  Queries(const Queries&) = delete;
  Queries& operator=(const Queries&) = delete;
  ~Queries() = default;

  [[nodiscard]] const Index& index() const { return exact_->index(); }

  /// Calls `f` with a searcher by the metric that no other thread uses.
  template <class F>
  auto with(Metric metric, F&& f) {
    return searchers_[static_cast<std::size_t>(metric)].with([&] { return Searcher(index(), metric); },
                                                             std::forward<F>(f));
  }

 private:
  std::shared_ptr<const ExactMethod> exact_;
  // By metric, of which `Space` is the last.
  std::array<Pool<Searcher>, static_cast<std::size_t>(Metric::Space) + 1> searchers_;
};

}  // namespace meshhood::python
