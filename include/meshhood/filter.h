// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood {

/// A set of vertices: one value for each vertex by the caller's ids, #V in total. A bool that is true, or a byte other
/// than 0, puts its vertex into the set. Borrowed; a temporary container is rejected by the compiler. Empty: no vertex.
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

  /// The number of values: #V, or 0.
  [[nodiscard]] std::size_t size() const { return bits_ != nullptr ? bits_->size() : bytes_.size(); }

  /// Whether the set has a vertex; `v` is less than `size()`.
  [[nodiscard]] bool operator[](VertexId v) const { return bits_ != nullptr ? (*bits_)[v] : bytes_[v] != 0; }

 private:
  std::span<const std::uint8_t> bytes_;
  const std::vector<bool>* bits_ = nullptr;  // instead of bytes
};

/// Restricts a search. Of a single query, a mask is read for the leaves that the search reaches, and not copied. A
/// batch copies it when the call begins.
struct Filter {
  /// The search does not pass these vertices, and they do not belong to its answer. The result is as if they were not
  /// in the mesh.
  VertexMask walls = {};

  /// The search passes these vertices, but they do not belong to its answer.
  VertexMask ignored = {};

  /// Whether there are no masks.
  [[nodiscard]] bool empty() const { return walls.size() == 0 && ignored.size() == 0; }
};

/// The graph without some of its edges. `build` of its view gives an index whose searches do not cross them.
///
/// edges  #cut by 2: the two ends of each edge, in either order; repeats are allowed.
///
/// Throws Error{InvalidOption} if the number of ends is odd, Error{VertexOutOfRange}, and Error{InvalidOption} if two
/// vertices are not joined by an edge; the message names the row of `edges`. O(#E + #cut log(valence)).
[[nodiscard]] Adjacency cut_edges(const AdjacencyView& graph, const IndicesView& edges);

}  // namespace meshhood
