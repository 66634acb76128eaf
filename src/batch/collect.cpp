// SPDX-License-Identifier: MIT
// Rows that are kept in memory, all in one array: they are counted first, so each goes to its place as it is found.
#include <algorithm>
#include <numeric>
#include <vector>

#include "batch/batch.h"

namespace meshhood {
namespace {

/// Calls `f(thread, row)` for every row.
template <class F>
void for_every_row(Batch& batch, F&& f) {
  for (std::size_t first = 0; first < batch.rows().size(); first += Batch::kMostRows) {
    const std::size_t count = std::min(Batch::kMostRows, batch.rows().size() - first);
    batch.for_each_row(first, count, [&](unsigned thread, std::size_t row) {
      f(thread, row);
      batch.work().advance(1);
      return true;
    });
  }
}

void count_rows(Batch& batch, std::uint64_t* sizes) {
  for_every_row(batch, [&](unsigned thread, std::size_t row) { sizes[row] = batch.count(thread, row); });
}

}  // namespace

std::vector<std::uint64_t> counts(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options) {
  Batch batch(index, query, options, 1);
  std::vector<std::uint64_t> result(batch.rows().size());
  count_rows(batch, result.data());
  batch.work().report();
  return result;
}

Neighborhoods neighborhoods(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options) {
  Batch batch(index, query, options, 2);
  Neighborhoods result;
  result.offsets.resize(batch.rows().size() + 1);
  count_rows(batch, result.offsets.data() + 1);
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.ids.resize(result.offsets.back());
  if (options.distances) result.distances.resize(result.offsets.back());
  // Not straight into their place, for what is written beyond the end would hit the next row.
  std::vector<std::vector<VertexId>> ids(batch.work().threads());
  for_every_row(batch, [&](unsigned thread, std::size_t row) {
    const std::size_t size = batch.search(thread, row);
    ids[thread].resize(std::max(ids[thread].size(), size + BatchSearcher::kRoom));
    batch.write(thread, size, ids[thread].data(),
                options.distances ? result.distances.data() + result.offsets[row] : nullptr);
    std::copy_n(ids[thread].begin(), size, result.ids.data() + result.offsets[row]);
  });
  batch.work().report();
  return result;
}

}  // namespace meshhood
