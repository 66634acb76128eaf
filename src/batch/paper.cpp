// SPDX-License-Identifier: MIT
#include "meshhood/paper.h"

#include <algorithm>
#include <vector>

#include "batch/batch.h"
#include "paper/index_access.h"
#include "paper/query_options.h"

namespace meshhood::paper {
namespace {

class PaperSearcher final : public BatchSearcher {
 public:
  PaperSearcher(const Index& index, const QueryOptions& options, bool with_distances)
      : searcher_(index), options_(options), with_distances_(with_distances) {}

  std::size_t count(VertexId v, double radius) override { return searcher_.count(v, radius, options_); }
  std::size_t search(VertexId v, double radius) override {
    if (with_distances_) {
      searcher_.neighborhood(v, radius, ids_, distances_, options_);
    } else {
      searcher_.neighborhood(v, radius, ids_, options_);
    }
    return ids_.size();
  }
  void write(VertexId* ids, double* distances) override {
    std::copy(ids_.begin(), ids_.end(), ids);
    if (distances != nullptr) std::copy(distances_.begin(), distances_.end(), distances);
  }

 private:
  Searcher searcher_;
  QueryOptions options_;
  bool with_distances_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

class PaperIndex final : public BatchIndex {
 public:
  PaperIndex(const Index& index, const QueryOptions& options) : index_(index), options_(options) { check(options); }

  [[nodiscard]] std::size_t vertex_count() const override { return index_.vertex_count(); }
  [[nodiscard]] std::uint32_t position_in_index(VertexId v) const override {
    return std::visit([v](const auto& hierarchy) { return static_cast<std::uint32_t>(hierarchy.lowest_cluster[v]); },
                      IndexAccess::hierarchy(index_));
  }
  [[nodiscard]] std::unique_ptr<BatchSearcher> make_searcher(bool with_distances) const override {
    return std::make_unique<PaperSearcher>(index_, options_, with_distances);
  }

 private:
  const Index& index_;
  QueryOptions options_;
};

}  // namespace

void for_each_neighborhood(const Index& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options, const QueryOptions& query_options) {
  meshhood::for_each_neighborhood(PaperIndex(index, query_options), query, sink, options);
}

Neighborhoods neighborhoods(const Index& index, const BatchQuery& query, const BatchOptions& options,
                            const QueryOptions& query_options) {
  return meshhood::neighborhoods(PaperIndex(index, query_options), query, options);
}

std::vector<std::uint64_t> neighborhoods(const Index& index, const BatchQuery& query, const BatchAllocator& allocate,
                                         const BatchOptions& options, const QueryOptions& query_options) {
  return meshhood::neighborhoods(PaperIndex(index, query_options), query, allocate, options);
}

std::vector<std::uint64_t> neighborhood_sizes(const Index& index, const BatchQuery& query, const BatchOptions& options,
                                              const QueryOptions& query_options) {
  return meshhood::neighborhood_sizes(PaperIndex(index, query_options), query, options);
}

}  // namespace meshhood::paper
