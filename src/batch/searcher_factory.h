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

  /// The index whose slots the positions are, of a method that has metrics; else null. Lives as long as the functions.
  const Index* of_slots = nullptr;

  /// Counting takes much less time than listing. If not, rows to be kept are searched once, and copied.
  bool is_count_cheap = false;

  /// Rows that lie between two multiples of this many positions are computed together.
  std::uint32_t positions_together = 1;

  /// Makes a search that answers rows together where that pays; empty if a searcher answers all one by one.
  std::function<std::unique_ptr<RowSearch>()> make_joint_search = {};

  /// The worker of a thread.
  [[nodiscard]] std::unique_ptr<BatchWorker> make_worker() const;
};

}  // namespace meshhood
