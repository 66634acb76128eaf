// SPDX-License-Identifier: MIT
#include "meshhood/search.h"

#include "batch/batch.h"
#include "index/index_access.h"
#include "search/output.h"
#include "search/searcher_state.h"

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
  void forget() override { state().cover.forget(); }

 private:
  SearcherAccess::State& state() { return SearcherAccess::state(searcher_); }

  Searcher searcher_;
  Point centre_{0, 0, 0};
};

class ExactIndex final : public BatchIndex {
 public:
  explicit ExactIndex(const Index& index) : index_(index) {}

  [[nodiscard]] std::size_t vertex_count() const override { return index_.vertex_count(); }
  [[nodiscard]] std::uint32_t place(VertexId v) const override { return IndexAccess::storage(index_).place[v]; }
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

std::vector<std::uint64_t> neighborhoods_into(const Index& index, const BatchQuery& query,
                                              const BatchAllocator& allocate, const BatchOptions& options) {
  return neighborhoods_into(ExactIndex(index), query, allocate, options);
}

std::vector<std::uint64_t> counts(const Index& index, const BatchQuery& query, const BatchOptions& options) {
  return counts(ExactIndex(index), query, options);
}

}  // namespace meshhood
