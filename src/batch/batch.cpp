// SPDX-License-Identifier: MIT
#include "batch/batch.h"

#include "batch/sort_answer.h"

namespace meshhood {

Batch::Batch(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options, std::size_t passes)
    : index_(index),
      options_(options),
      rows_(query, index.vertex_count()),
      task_(options.threads, options.progress, passes * rows_.size()),
      searchers_(task_.threads()) {}

void Batch::put_in_index_order(std::size_t first, std::size_t count) {
  in_order_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    in_order_[i] = (std::uint64_t{index_.position_in_index(rows_.vertex(first + i))} << 32) + i;
  }
  std::sort(in_order_.begin(), in_order_.end());
}

void Batch::begin_chunk(unsigned thread) {
  std::unique_ptr<BatchSearcher>& searcher = searchers_[thread];
  if (!searcher) searcher = index_.make_searcher(options_.distances);
  // Which chunks a thread gets is chance.
  searcher->forget();
}

std::size_t Batch::search(unsigned thread, std::size_t row) {
  return searchers_[thread]->search(rows_.vertex(row), rows_.radius(row));
}

void Batch::write(unsigned thread, std::size_t size, VertexId* ids, double* distances) {
  searchers_[thread]->write(ids, distances);
  if (options_.sorted) sort_answer({ids, size}, {distances, distances == nullptr ? 0 : size});
}

std::size_t Batch::count(unsigned thread, std::size_t row) {
  return searchers_[thread]->count(rows_.vertex(row), rows_.radius(row));
}

}  // namespace meshhood
