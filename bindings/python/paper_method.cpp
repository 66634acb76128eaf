// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "meshhood/paper.h"

#include "indexed_method.h"
#include "methods.h"

namespace meshhood::python {
namespace {

/// The hierarchy and how it is asked: with this it has the calls of the exact index.
struct PaperIndex {
  std::shared_ptr<const paper::Index> hierarchy;
  paper::QueryOptions options;
};

class PaperSearcher {
 public:
  explicit PaperSearcher(const PaperIndex& index) : searcher_(*index.hierarchy), options_(index.options) {}

  void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids) {
    searcher_.neighborhood(v, radius, ids, options_);
  }

  void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids, std::vector<double>& distances) {
    searcher_.neighborhood(v, radius, ids, distances, options_);
  }

  std::size_t count(VertexId v, double radius) { return searcher_.count(v, radius, options_); }

 private:
  paper::Searcher searcher_;
  paper::QueryOptions options_;
};

std::vector<std::uint64_t> neighborhoods(const PaperIndex& index, const BatchQuery& query,
                                         const BatchAllocator& allocate, const BatchOptions& options) {
  return paper::neighborhoods(*index.hierarchy, query, allocate, options, index.options);
}

std::vector<std::uint64_t> neighborhood_sizes(const PaperIndex& index, const BatchQuery& query,
                                              const BatchOptions& options) {
  return paper::neighborhood_sizes(*index.hierarchy, query, options, index.options);
}

}  // namespace

std::shared_ptr<Method> paper_method(std::shared_ptr<const paper::Index> hierarchy,
                                     const paper::QueryOptions& options) {
  return std::make_shared<IndexMethod<Method, PaperIndex, PaperSearcher>>(PaperIndex{std::move(hierarchy), options});
}

}  // namespace meshhood::python
