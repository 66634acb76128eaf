// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "base/parallel.h"
#include "exact/arrays.h"
#include "exact/layout.h"

namespace meshhood {

/// The door between an index and what it is made of: for `build`, for files, and for tests that look inside.
struct IndexAccess {
  [[nodiscard]] static Index make(std::unique_ptr<const IndexView> view) { return Index(std::move(view)); }
  [[nodiscard]] static Index make(IndexData arrays) { return make(make_view(std::move(arrays))); }

  [[nodiscard]] static const IndexView& view(const Index& index) { return *index.view_; }

  /// How many parts the work of a build has, for whoever watches: graph, leaves, links, spheres and regions, tree,
  /// arrays.
  static constexpr std::size_t kBuildSteps = 6;

  /// The steps after the graph; leaves the last report to the caller.
  [[nodiscard]] static IndexData build_valid(const GraphView& graph, TaskContext& task);
};

}  // namespace meshhood
