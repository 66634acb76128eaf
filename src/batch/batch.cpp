// SPDX-License-Identifier: MIT
#include "batch/batch.h"

namespace meshhood {

Batch::Batch(const SearchMethod& method, const BatchQuery& query, const BatchOptions& options, std::size_t passes)
    : factory_(method.searchers()),
      options_(options),
      rows_(query, factory_.vertex_count()),
      task_(options.threads, options.progress, passes * rows_.size()),
      workers_(task_.threads()) {}

BatchWorker& Batch::worker(unsigned thread) {
  std::unique_ptr<BatchWorker>& worker = workers_[thread];
  if (!worker) worker = factory_.make_worker();
  return *worker;
}

}  // namespace meshhood
