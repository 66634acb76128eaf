// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/edge_search.h"
#include "meshhood/region.h"

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

  /// Calls `f` with a searcher that no other thread uses.
  template <class F>
  auto with_regions(F&& f) {
    return regions_.with([this] { return RegionSearcher(index()); }, std::forward<F>(f));
  }
  template <class F>
  auto with_edges(F&& f) {
    return edges_.with([this] { return EdgeSearcher(index()); }, std::forward<F>(f));
  }

 private:
  std::shared_ptr<const ExactMethod> exact_;
  Pool<RegionSearcher> regions_;
  Pool<EdgeSearcher> edges_;
};

}  // namespace meshhood::python
