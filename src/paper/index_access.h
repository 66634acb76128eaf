// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "paper/hierarchy.h"

namespace meshhood::paper {

/// The door between an index and what it is made of: for `build`, and for tests that damage an index on purpose.
struct IndexAccess {
  [[nodiscard]] static Index make(AnyHierarchy hierarchy) {
    return Index(std::make_unique<const Index::Storage>(Index::Storage{std::move(hierarchy)}));
  }

  [[nodiscard]] static const AnyHierarchy& hierarchy(const Index& index) { return index.storage_->hierarchy; }
};

}  // namespace meshhood::paper
