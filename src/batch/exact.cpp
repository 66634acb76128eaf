// SPDX-License-Identifier: MIT
#include "meshhood/search.h"

#include "batch/batch.h"
#include "exact/index_access.h"
#include "exact/search/output.h"
#include "exact/search/searcher_state.h"

namespace meshhood {
namespace {

class ExactSearcher final : public BatchSearcher {
 public:
  explicit ExactSearcher(const Index& index) : searcher_(index) {}

  std::size_t count(VertexId v, double radius) override { return searcher_.count(v, radius); }
  std::size_t search(VertexId v, double radius) override {
    centre_ = state().search(v, radius);
    return meshhood::count(state().answer);
  }
  void write(VertexId* ids, double* distances) override {
    static_assert(kRoom >= kLeafCapacity);
    write_ids(state().answer, *state().index, *state().kernels, ids);
    if (distances != nullptr) write_distances(state().answer, *state().index, centre_, distances);
  }
  void forget() override { state().ball_search.forget(); }

 private:
  SearcherAccess::State& state() { return SearcherAccess::state(searcher_); }

  Searcher searcher_;
  Point centre_{0, 0, 0};
};

class ExactIndex final : public BatchIndex {
 public:
  explicit ExactIndex(const Index& index) : index_(index) {}

  [[nodiscard]] std::size_t vertex_count() const override { return index_.vertex_count(); }
  [[nodiscard]] std::uint32_t position_in_index(VertexId v) const override { return IndexAccess::view(index_).slot[v]; }
  [[nodiscard]] std::unique_ptr<BatchSearcher> make_searcher(bool /*with_distances*/) const override {
    return std::make_unique<ExactSearcher>(index_);
  }

 private:
  const Index& index_;
};

}  // namespace

void for_each_neighborhood(const Index& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options) {
  for_each_neighborhood(ExactIndex(index), query, sink, options);
}

Neighborhoods neighborhoods(const Index& index, const BatchQuery& query, const BatchOptions& options) {
  return neighborhoods(ExactIndex(index), query, options);
}

std::vector<std::uint64_t> neighborhoods(const Index& index, const BatchQuery& query, const BatchAllocator& allocate,
                                         const BatchOptions& options) {
  return neighborhoods(ExactIndex(index), query, allocate, options);
}

std::vector<std::uint64_t> neighborhood_sizes(const Index& index, const BatchQuery& query,
                                              const BatchOptions& options) {
  return neighborhood_sizes(ExactIndex(index), query, options);
}

}  // namespace meshhood
