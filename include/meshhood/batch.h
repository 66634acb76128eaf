// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/progress.h"

/// Many neighborhoods in one call, on as many threads as wanted.
///
///     const auto [offsets, ids, distances] = meshhood::neighborhoods(index, {.radius = 1.5}, {.threads = 0});
namespace meshhood {

/// Which neighborhoods a batch asks for, one a row. Borrowed for the call.
struct BatchQuery {
  /// The vertex of each row, in [0, #V), in any order, repeats allowed. Nothing: all vertices in order.
  std::optional<std::span<const VertexId>> vertices = std::nullopt;

  /// One radius for all rows or one for each, >= 0 or infinite, in the unit of the positions; a vertex at exactly the
  /// radius counts. To be given: what stands here is refused.
  std::variant<double, std::span<const double>> radius = std::numeric_limits<double>::quiet_NaN();
};

/// How a batch is worked off. The answers, and their order, do not depend on `threads`.
struct BatchOptions {
  /// The calling thread included; 0: as many as the processor has; at most `kMaxThreads`. With 1, none is started.
  unsigned threads = 1;

  bool distances = false;  ///< the distance of each vertex as well (see `distance`); where only counted, ignored
  bool sorted = false;     ///< ids of a row ascend; otherwise in no stated order, but always the same

  /// How many bytes of answers may wait for their turn. More let rows in any order be worked off in index order, and
  /// keep threads busy; the processor's cache holds fewer.
  std::size_t buffer_bytes = std::size_t{8} << 20;

  /// Called between queries, twenty times a second at most; no further one is begun once it returns false.
  Progress progress = {};
};

/// One neighborhood of a batch; lives as long as the call of the sink.
struct BatchRow {
  std::size_t row;                    ///< ascends from 0
  std::span<const VertexId> ids;      ///< without duplicates, the query vertex included
  std::span<const double> distances;  ///< in the order of `ids`; empty unless asked for
};

using RowSink = std::function<void(const BatchRow&)>;

/// All rows in CSR form: row `i` has the ids `ids[offsets[i]] .. ids[offsets[i + 1] - 1]`, and so the distances.
struct Neighborhoods {
  std::vector<std::uint64_t> offsets;  ///< #rows + 1
  std::vector<VertexId> ids;
  std::vector<double> distances;  ///< empty unless asked for
};

/// Where rows that are kept go: room for all their ids, and for as many distances if they are asked for.
struct BatchMemory {
  std::span<VertexId> ids;
  std::span<double> distances = {};
};

/// Gives memory for `count` ids.
using BatchAllocator = std::function<BatchMemory(std::size_t count)>;

/// Hands the rows to `sink` one after the other, in their order, on the calling thread; the other threads rest
/// meanwhile. Memory: `buffer_bytes`, and for each thread a `Searcher` and two answers.
///
/// All arguments are checked before the first row is worked off. An exception from `sink` or `options.progress`, or
/// from a lack of memory, ends the batch once all threads have come to rest, and is passed on; the index may be asked
/// again.
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
void for_each_neighborhood(const Index& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options = {});

/// The same rows, kept in memory. They are counted first, so that memory is taken once and no more than needed: each is
/// asked twice. Throws as `for_each_neighborhood`.
[[nodiscard]] Neighborhoods neighborhoods(const Index& index, const BatchQuery& query,
                                          const BatchOptions& options = {});

/// The same rows in memory of the caller's own, and their offsets. `allocate` is called once, on the calling thread,
/// once the rows are counted; all of the memory is then written, unless the batch ends before its time. What `allocate`
/// throws is passed on.
/// Throws as `for_each_neighborhood`, and Error{InvalidOption} where the memory is not of the size that was asked for.
[[nodiscard]] std::vector<std::uint64_t> neighborhoods(const Index& index, const BatchQuery& query,
                                                       const BatchAllocator& allocate,
                                                       const BatchOptions& options = {});

/// How many vertices each row has. Throws as `for_each_neighborhood`.
[[nodiscard]] std::vector<std::uint64_t> neighborhood_sizes(const Index& index, const BatchQuery& query,
                                                            const BatchOptions& options = {});

}  // namespace meshhood

/// The same for the answers of the paper's index; Error{InvalidOption} where `query_options` are out of range, too.
namespace meshhood::paper {

void for_each_neighborhood(const Index& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options = {}, const QueryOptions& query_options = {});

[[nodiscard]] Neighborhoods neighborhoods(const Index& index, const BatchQuery& query, const BatchOptions& options = {},
                                          const QueryOptions& query_options = {});

[[nodiscard]] std::vector<std::uint64_t> neighborhoods(const Index& index, const BatchQuery& query,
                                                       const BatchAllocator& allocate, const BatchOptions& options = {},
                                                       const QueryOptions& query_options = {});

[[nodiscard]] std::vector<std::uint64_t> neighborhood_sizes(const Index& index, const BatchQuery& query,
                                                            const BatchOptions& options = {},
                                                            const QueryOptions& query_options = {});

}  // namespace meshhood::paper
