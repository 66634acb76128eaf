// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "meshhood/batch.h"
#include "meshhood/search.h"

#include "batch/worker.h"

namespace meshhood {

/// What a `SearchMethod` refers to. Any thread may call the functions.
struct SearcherFactory {
  std::size_t vertex_count;

  /// Makes a searcher, for one thread.
  std::function<AnySearcher()> make_searcher;

  /// Ascends with the order in which vertices are best searched: near vertices have near positions.
  std::function<std::uint32_t(VertexId v)> position;

  /// The index whose slots the positions are; null if they are others. Lives as long as the functions.
  const Index* of_slots = nullptr;

  /// Counting takes much less time than listing. If not, rows to be kept are searched once, and copied.
  bool is_count_cheap = false;

  /// Rows that lie between two multiples of this many positions are computed together.
  std::uint32_t positions_together = 1;

  /// The same method with answers that a filter restricts; empty if it has no filters, or already one. Copies the
  /// masks. Throws Error{InvalidOption} unless each is empty or has a value for each vertex.
  std::function<std::shared_ptr<const SearcherFactory>(const Filter& filter, unsigned threads)> with_filter = {};

  /// Makes a search that answers rows together; empty if rows are answered one by one, by a searcher.
  std::function<std::unique_ptr<RowSearch>()> make_joint_search = {};

  /// The worker of a thread.
  [[nodiscard]] std::unique_ptr<BatchWorker> make_worker() const;

  /// As `with_filter`; refuses it where that is empty.
  [[nodiscard]] std::shared_ptr<const SearcherFactory> restricted(const Filter& filter, unsigned threads) const;
};

/// The method of the same index by another metric. Throws Error{InvalidOption} if there is none.
[[nodiscard]] SearchMethod by_metric(const SearchMethod& method, Metric metric);

}  // namespace meshhood
