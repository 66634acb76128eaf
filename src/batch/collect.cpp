// SPDX-License-Identifier: MIT
// Rows that are kept in memory, all in one array: they are counted first, so each goes to its place as it is found.
#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "meshhood/error.h"

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
      batch.task().advance(1);
      return true;
    });
  }
}

void count_rows(Batch& batch, std::uint64_t* sizes) {
  for_every_row(batch, [&](unsigned thread, std::size_t row) { sizes[row] = batch.count(thread, row); });
}

BatchMemory allocated(const BatchAllocator& allocate, std::size_t count, bool distances) {
  const BatchMemory memory = allocate(count);
  const auto verify = [count](std::size_t size, const char* what) {
    if (size == count) return;
    raise(ErrorCode::InvalidOption,
          "memory for " + std::to_string(size) + what + ", expected for " + std::to_string(count));
  };
  verify(memory.ids.size(), " ids");
  if (distances) verify(memory.distances.size(), " distances");
  return memory;
}

/// Every row where its offset says.
void write_rows(Batch& batch, std::span<const std::uint64_t> offsets, const BatchMemory& memory) {
  // Not straight into their place, for what is written beyond the end would hit the next row.
  std::vector<std::vector<VertexId>> ids(batch.task().threads());
  for_every_row(batch, [&](unsigned thread, std::size_t row) {
    const std::size_t size = batch.search(thread, row);
    ids[thread].resize(std::max(ids[thread].size(), size + BatchSearcher::kRoom));
    batch.write(thread, size, ids[thread].data(),
                batch.options().distances ? memory.distances.data() + offsets[row] : nullptr);
    std::copy_n(ids[thread].begin(), size, memory.ids.data() + offsets[row]);
  });
}

}  // namespace

std::vector<std::uint64_t> neighborhood_sizes(const BatchIndex& index, const BatchQuery& query,
                                              const BatchOptions& options) {
  Batch batch(index, query, options, 1);
  std::vector<std::uint64_t> result(batch.rows().size());
  count_rows(batch, result.data());
  batch.task().report_progress();
  return result;
}

std::vector<std::uint64_t> neighborhoods(const BatchIndex& index, const BatchQuery& query,
                                         const BatchAllocator& allocate, const BatchOptions& options) {
  if (!allocate) raise(ErrorCode::InvalidOption, "allocate is empty, expected a function");
  Batch batch(index, query, options, 2);
  std::vector<std::uint64_t> offsets(batch.rows().size() + 1);
  count_rows(batch, offsets.data() + 1);
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  write_rows(batch, offsets, allocated(allocate, offsets.back(), options.distances));
  batch.task().report_progress();
  return offsets;
}

Neighborhoods neighborhoods(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options) {
  Neighborhoods result;
  const auto allocate = [&](std::size_t count) -> BatchMemory {
    result.ids.resize(count);
    if (options.distances) result.distances.resize(count);
    return {result.ids, result.distances};
  };
  result.offsets = neighborhoods(index, query, allocate, options);
  return result;
}

}  // namespace meshhood
