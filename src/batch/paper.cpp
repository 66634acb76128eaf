// SPDX-License-Identifier: MIT
#include "meshhood/paper.h"

#include "batch/batch.h"
#include "paper/index_access.h"
#include "paper/query_options.h"

namespace meshhood::paper {
namespace {

class PaperSearcher final : public BatchSearcher {
 public:
  PaperSearcher(const Index& index, const QueryOptions& options) : searcher_(index), options_(options) {}

  void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids) override {
    searcher_.neighborhood(v, radius, ids, options_);
  }
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids, std::vector<double>& distances) override {
    searcher_.neighborhood(v, radius, ids, distances, options_);
  }
  std::size_t count(VertexId v, double radius) override { return searcher_.count(v, radius, options_); }

 private:
  Searcher searcher_;
  QueryOptions options_;
};

class PaperIndex final : public BatchIndex {
 public:
  PaperIndex(const Index& index, const QueryOptions& options) : index_(index), options_(options) { check(options); }

  [[nodiscard]] std::size_t vertex_count() const override { return index_.vertex_count(); }
  [[nodiscard]] std::uint32_t place(VertexId v) const override {
    return std::visit([v](const auto& hierarchy) { return static_cast<std::uint32_t>(hierarchy.lowest_cluster[v]); },
                      IndexAccess::hierarchy(index_));
  }
  [[nodiscard]] std::unique_ptr<BatchSearcher> make_searcher() const override {
    return std::make_unique<PaperSearcher>(index_, options_);
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

std::vector<std::uint64_t> counts(const Index& index, const BatchQuery& query, const BatchOptions& options,
                                  const QueryOptions& query_options) {
  return meshhood::counts(PaperIndex(index, query_options), query, options);
}

}  // namespace meshhood::paper
