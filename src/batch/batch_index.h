// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "meshhood/mesh.h"

namespace meshhood {

/// A searcher as a batch sees it: one object a thread.
class BatchSearcher {
 public:
  BatchSearcher() = default;
  BatchSearcher(const BatchSearcher&) = delete;
  BatchSearcher& operator=(const BatchSearcher&) = delete;
  virtual ~BatchSearcher() = default;

  [[nodiscard]] virtual std::size_t count(VertexId v, double radius) = 0;

  /// Finds a neighborhood and returns its size.
  [[nodiscard]] virtual std::size_t search(VertexId v, double radius) = 0;

  /// Writes what the last `search` found. `ids` has room for `kRoom` more, which may be used; `distances` is null
  /// unless the searcher was made for them.
  virtual void write(VertexId* ids, double* distances) = 0;
  static constexpr std::size_t kRoom = 32;

  /// What follows does not depend on what went before.
  virtual void forget() {}
};

/// Either index as a batch sees it.
class BatchIndex {
 public:
  BatchIndex() = default;
  BatchIndex(const BatchIndex&) = delete;
  BatchIndex& operator=(const BatchIndex&) = delete;
  virtual ~BatchIndex() = default;

  [[nodiscard]] virtual std::size_t vertex_count() const = 0;

  /// Ascends with the index order: vertices of near places lie close together.
  [[nodiscard]] virtual std::uint32_t position_in_index(VertexId v) const = 0;

  [[nodiscard]] virtual std::unique_ptr<BatchSearcher> make_searcher(bool with_distances) const = 0;
};

}  // namespace meshhood
