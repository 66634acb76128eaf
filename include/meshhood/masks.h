// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Borrows a set of vertices: one value for each vertex by the caller's ids, #V in total. A bool that is true, or a
/// byte other than 0, puts its vertex into the set. An empty mask has no vertex. The compiler rejects a temporary
/// container.
class VertexMask {
 public:
  VertexMask() = default;

  template <BorrowedArray<std::uint8_t> Range>
  VertexMask(Range&& bytes) : bytes_(bytes) {}

  template <BorrowedArray<bool> Range>
  VertexMask(Range&& values)
      : bytes_(reinterpret_cast<const std::uint8_t*>(std::span<const bool>(values).data()), std::ranges::size(values)) {
  }

  VertexMask(const std::vector<bool>& bits) : bits_(&bits) {}
  VertexMask(const std::vector<bool>&&) = delete;

  /// Returns the number of values: #V, or 0.
  [[nodiscard]] std::size_t size() const { return bits_ != nullptr ? bits_->size() : bytes_.size(); }

  /// Returns whether the set has vertex `v`, which is less than `size()`.
  [[nodiscard]] bool operator[](VertexId v) const { return bits_ != nullptr ? (*bits_)[v] : bytes_[v] != 0; }

 private:
  std::span<const std::uint8_t> bytes_;
  const std::vector<bool>* bits_ = nullptr;  // instead of bytes
};

/// The walls and ignored vertices of a masked index. The compiler rejects a temporary container.
struct Masks {
  /// Searches do not pass these vertices, and they do not belong to answers, as if they were not in the mesh. The
  /// neighborhood of a wall is empty.
  VertexMask walls = {};

  /// Searches pass these vertices, but they do not belong to answers.
  VertexMask ignored = {};
};

/// Returns the same index with masks: every search of it, and every call that takes it, leaves out walls and ignored
/// vertices; `nearest` and `Start::nearest` find ignored ones. A wall as a seed leads nowhere. The masks are copied;
/// the arrays of `index` are shared, all of which remain valid without the walls. Needs some 50 bytes a leaf with
/// walls, and 4 with ignored vertices alone. A search takes about as long as without masks. But what patches (see
/// patch.h) and `surface_paths` need of the faces is made anew for each set of walls, which takes as long as a build.
///
/// An index with masks is not saved, checked, refitted or masked again. After `refit_in_place` of `index`,
/// it refuses to answer, as a searcher does. Its mesh, as from `extract_graph`, is the whole one.
///
/// Takes O(#V). Throws Error{InvalidOption} unless each mask is empty or has a value for each vertex, or if `index` has
/// masks, and Error{Cancelled}.
[[nodiscard]] Index masked(const Index& index, const Masks& masks, const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
