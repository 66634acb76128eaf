// SPDX-License-Identifier: MIT
#include <memory>
#include <utility>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/search.h"

#include "indexed_method.h"
#include "methods.h"

namespace meshhood::python {
namespace {

class IndexedExactMethod : public IndexMethod<ExactMethod, Index, Searcher> {
 public:
  using IndexMethod::IndexMethod;

  [[nodiscard]] const Index& index() const override { return built(); }

  std::vector<VertexRange> ranges(VertexId v, double radius) override {
    return ask([&](Searcher& searcher) {
      const auto ranges = searcher.ranges(v, radius);
      return std::vector(ranges.begin(), ranges.end());
    });
  }
};

}  // namespace

std::shared_ptr<ExactMethod> exact_method(Index index) {
  return std::make_shared<IndexedExactMethod>(std::move(index));
}

}  // namespace meshhood::python
