// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "index/layout.h"
#include "parallel.h"

namespace meshhood {

/// The door between an index and what it is made of: for `build`, and for tests that look inside.
struct IndexAccess {
  [[nodiscard]] static Index make(std::unique_ptr<const IndexStorage> storage) { return Index(std::move(storage)); }

  [[nodiscard]] static const IndexStorage& storage(const Index& index) { return *index.storage_; }

  [[nodiscard]] static Index build_valid(const GraphView& graph, Work& work);
};

}  // namespace meshhood
