// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "index/arrays.h"
#include "index/layout.h"
#include "parallel.h"

namespace meshhood {

/// The door between an index and what it is made of: for `build`, for files, and for tests that look inside.
struct IndexAccess {
  [[nodiscard]] static Index make(std::unique_ptr<const IndexStorage> storage) { return Index(std::move(storage)); }
  [[nodiscard]] static Index make(IndexArrays arrays) { return make(make_storage(std::move(arrays))); }

  [[nodiscard]] static const IndexStorage& storage(const Index& index) { return *index.storage_; }

  /// How many parts the work of a build has, for whoever watches: graph, leaves, links, spheres and columns, tree,
  /// arrays.
  static constexpr std::size_t kBuildSteps = 6;

  /// The steps after the graph; leaves the last report to the caller.
  [[nodiscard]] static IndexArrays build_valid(const GraphView& graph, Work& work);
};

}  // namespace meshhood
