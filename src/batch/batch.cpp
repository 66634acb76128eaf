// SPDX-License-Identifier: MIT
#include "batch/batch.h"

#include "batch/sort_answer.h"

namespace meshhood {

Batch::Batch(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options, std::size_t passes)
    : index_(index),
      options_(options),
      rows_(query, index.vertex_count()),
      work_(options.threads, options.progress, passes * rows_.size()),
      workers_(work_.threads()) {}

void Batch::put_in_index_order(std::size_t first, std::size_t count) {
  in_order_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    in_order_[i] = (std::uint64_t{index_.place(rows_.vertex(first + i))} << 32) + i;
  }
  std::sort(in_order_.begin(), in_order_.end());
}

void Batch::begin_chunk(unsigned thread) {
  std::unique_ptr<BatchSearcher>& searcher = workers_[thread].searcher;
  if (!searcher) searcher = index_.make_searcher();
  // Which chunks a thread gets is chance.
  searcher->forget();
}

const BatchWorker& Batch::ask(unsigned thread, std::size_t row) {
  BatchWorker& worker = workers_[thread];
  if (options_.distances) {
    worker.searcher->neighborhood(rows_.vertex(row), rows_.radius(row), worker.ids, worker.distances);
  } else {
    worker.searcher->neighborhood(rows_.vertex(row), rows_.radius(row), worker.ids);
  }
  if (options_.sorted) sort_answer(worker.ids, worker.distances);
  return worker;
}

std::size_t Batch::count(unsigned thread, std::size_t row) {
  return workers_[thread].searcher->count(rows_.vertex(row), rows_.radius(row));
}

}  // namespace meshhood
