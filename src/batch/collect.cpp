// SPDX-License-Identifier: MIT
// All rows are kept in one array. They are counted first, so that each is written to its final place. Their answers are
// kept meanwhile, in less memory than the ids take, so that most rows are searched once.
#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/prefetch.h"
#include "batch/batch.h"
#include "batch/rows.h"
#include "shared/large_pages.h"
#include "shared/row_order.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

/// Refuses a result that is far too large, by the sizes of a sample of the rows.
void check_sample(Batch& batch, const SizeLimit& limit) {
  constexpr std::size_t kWorthwhile = 256;  // rows for each of the sample, whose search alone takes as long as several
  const std::size_t rows = batch.rows().size();
  if (rows < kWorthwhile * SizeLimit::kSample ||
      limit.allows(static_cast<double>(rows) * static_cast<double>(batch.vertex_count()))) {
    return;
  }
  std::vector<double> sizes(SizeLimit::kSample);
  const auto row_of = [&limit](std::size_t i) { return limit.sampled_row(i); };
  batch.for_each_chunk(sizes.size(), row_of, [&](unsigned thread, const BatchChunk& chunk) {
    const auto sink = [&](std::span<const BatchItem> items, std::span<const std::uint64_t> some) {
      for (std::size_t i = 0; i < items.size(); ++i) {
        sizes[items[i].row / limit.stretch()] = static_cast<double>(some[i]);
      }
      return batch.task().should_continue(thread);
    };
    batch.worker(thread).count(chunk.items, sink, nullptr, false);
  });
  limit.check_sample(sizes, "about ");
}

SizeLimit limit_of(const BatchOptions& options, const Run& run, std::size_t rows) {
  return {run.max_bytes, sizeof(VertexId) + (options.distances ? sizeof(double) : 0), rows};
}

/// Rows that are counted first and written later need a limit for their ids, and a place for what was found.
struct ForWriting {
  SizeLimit& limit;
  KeptChunks& kept;
};

/// Counts ids that a thread has not yet added to the limit (see `share_at_once`), in a cache line of its own.
struct alignas(64) NewIds {
  std::uint64_t count = 0;
};

/// `writing` is null for rows that are only counted.
void count_rows(Batch& batch, std::uint64_t* sizes, const ForWriting* writing) {
  const unsigned threads = batch.task().threads();
  const std::uint64_t most_ids = writing == nullptr ? 0 : share_at_once(writing->limit.max_items(), threads);
  std::vector<NewIds> new_ids(threads);
  batch.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
    std::uint64_t& ids = new_ids[thread].count;
    const auto sink = [&](std::span<const BatchItem> items, std::span<const std::uint64_t> some) {
      for (std::size_t i = 0; i < items.size(); ++i) ids += sizes[items[i].row] = some[i];
      return batch.task().should_continue(thread);
    };
    KeptPackets* const kept = writing == nullptr ? nullptr : &writing->kept.begin(thread, chunk.number);
    batch.worker(thread).count(chunk.items, sink, kept, batch.options().distances);
    if (writing != nullptr && ids >= most_ids) writing->limit.add(std::exchange(ids, 0));
    batch.task().advance(thread, chunk.items.size());
  });
  if (writing == nullptr) return;
  for (const NewIds& ids : new_ids) writing->limit.add(ids.count);
}

/// Searches each row once. The rows wait in memory of the library until their number of ids is known.
std::vector<std::uint64_t> stream_and_copy(const SearchMethod& method, const BatchQuery& query,
                                           const BatchAllocator& allocate, const BatchOptions& options,
                                           const Run& run) {
  SizeLimit limit = limit_of(options, run, query.vertices.count(method.vertex_count()));
  Neighborhoods rows{{0}, {}, {}};
  const auto append = [&](const BatchRow& row) {
    limit.add(row.ids.size());
    rows.ids.insert(rows.ids.end(), row.ids.begin(), row.ids.end());
    rows.distances.insert(rows.distances.end(), row.distances.begin(), row.distances.end());
    rows.offsets.push_back(rows.ids.size());
  };
  BatchOptions in_row_order = options;
  in_row_order.in_index_order = false;
  for_each_neighborhood(method, query, append, in_row_order, run);
  const BatchMemory memory = allocated(allocate, rows.ids.size(), options.distances);
  std::copy(rows.ids.begin(), rows.ids.end(), memory.ids.begin());
  std::copy(rows.distances.begin(), rows.distances.end(), memory.distances.begin());
  return std::move(rows.offsets);
}

/// Moves each row to its offset.
class RowsInPlace final : public RowReceiver {
 public:
  RowsInPlace(Batch& batch, unsigned thread, std::span<const std::uint64_t> offsets, const BatchMemory& memory)
      : batch_(batch), thread_(thread), offsets_(offsets), memory_(memory), order_(batch.options().sort) {}

  BatchMemory memory(std::size_t row, std::size_t size) override {
    last_.ids = memory_.ids.subspan(offsets_[row], size);
    if (batch_.options().distances) last_.distances = memory_.distances.subspan(offsets_[row], size);
    return last_;
  }

  bool done(std::size_t /*row*/) override {
    constexpr std::size_t kIdsBetweenLooks = 4096;  // a look at the clock takes a tenth of the time of a small row
    order_.sort(last_.ids, last_.distances);
    ids_since_look_ += last_.ids.size();
    if (ids_since_look_ < kIdsBetweenLooks) return true;
    ids_since_look_ = 0;
    return batch_.task().should_continue(thread_);
  }

 private:
  Batch& batch_;
  unsigned thread_;
  std::span<const std::uint64_t> offsets_;
  BatchMemory memory_;
  BatchMemory last_;
  RowOrder order_;
  std::size_t ids_since_look_ = 0;
};

/// Prefetches the first lines of a row, because the rows of a chunk lie far from each other. The processor itself
/// fetches what follows.
void prefetch_row(std::span<const VertexId> ids) {
  constexpr std::size_t kLines = 4;
  fetch_lines(ids.data(), kLines);
}

void write_rows(Batch& batch, KeptChunks& kept, std::span<const std::uint64_t> offsets, const BatchMemory& memory) {
  batch.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
    for (const BatchItem& item : chunk.items) prefetch_row(memory.ids.subspan(offsets[item.row]));
    RowsInPlace receiver(batch, thread, offsets, memory);
    batch.worker(thread).find(chunk.items, batch.options().distances, receiver, kept.find(thread, chunk.number));
    batch.task().advance(thread, chunk.items.size());
  });
}

}  // namespace

std::vector<std::uint64_t> counts(const SearchMethod& method, const BatchQuery& query, const Run& run) {
  const std::vector<BatchRadius> passes = radius_of_passes(query.radius);
  Batch batch(method, {query.vertices, passes.front(), query.metric}, {}, run, passes.size());
  std::vector<std::uint64_t> result(query.result_rows(method.vertex_count()));
  for (std::size_t i = 0; i < passes.size(); ++i) {
    if (i > 0) batch.begin_pass(passes[i].common());
    count_rows(batch, result.data(), nullptr);
  }
  batch.task().finish();
  return result;
}

std::vector<std::uint64_t> neighborhoods(const SearchMethod& method, const BatchQuery& query,
                                         const BatchAllocator& allocate, const BatchOptions& options, const Run& run) {
  check_function(allocate, "allocate");
  if (!method.factory().is_count_cheap) return stream_and_copy(method, query, allocate, options, run);
  Batch batch(method, query, options, run, 2);
  SizeLimit limit = limit_of(options, run, batch.rows().size());
  check_sample(batch, limit);
  std::vector<std::uint64_t> offsets(batch.rows().size() + 1);
  KeptChunks kept(batch.task().threads());
  const ForWriting writing{limit, kept};
  count_rows(batch, offsets.data() + 1, &writing);
  kept.finish();
  if (!limit.leaves(kept.bytes())) kept.clear();
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  write_rows(batch, kept, offsets, allocated(allocate, offsets.back(), options.distances));
  batch.task().finish();
  return offsets;
}

Neighborhoods neighborhoods(const SearchMethod& method, const BatchQuery& query, const BatchOptions& options,
                            const Run& run) {
  Neighborhoods result;
  const auto allocate = [&](std::size_t count) -> BatchMemory {
    result.ids = make_values<VertexId>(count);
    if (options.distances) result.distances = make_values<double>(count);
    return {result.ids, result.distances};
  };
  result.offsets = neighborhoods(method, query, allocate, options, run);
  return result;
}

}  // namespace meshhood::inline v0_1
