// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "paper/hierarchy.h"

namespace meshhood::paper {

/// Access to the data of an index, for `build`, for files, and for tests that damage an index on purpose.
struct IndexAccess {
  [[nodiscard]] static Index make(AnyHierarchy hierarchy, const Fingerprint& mesh = {}) {
    return Index(std::make_unique<const Index::Storage>(Index::Storage{std::move(hierarchy), mesh}));
  }

  [[nodiscard]] static const Fingerprint& mesh(const Index& index) { return index.storage_->mesh; }

  [[nodiscard]] static const AnyHierarchy& hierarchy(const Index& index) { return index.storage_->hierarchy; }
};

}  // namespace meshhood::paper
