// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "meshhood/export.h"
#include "meshhood/vertex_id.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

namespace detail {

template <class Handle>
concept VertexHandle = std::is_class_v<Handle> && requires(const Handle& handle) { VertexId{handle}; } &&
                       !requires(const Handle& handle) { bool{handle}; };

}  // namespace detail

/// A vertex as an argument. An integer of 64 bits is never cut to the id of another vertex, and a bool or a
/// floating-point number is not accepted.
class Vertex {
 public:
  /// An integer that no `VertexId` can hold becomes `kNoVertex`, which every call refuses; the message then names
  /// 4294967295.
  template <std::integral Integer>
    requires(!std::same_as<Integer, bool>)
  Vertex(Integer v) : id_(std::in_range<VertexId>(v) ? static_cast<VertexId>(v) : kNoVertex) {}

  /// Takes a vertex of another library whose type converts to `VertexId` without a loss, as `CGAL::SM_Vertex_index`.
  template <detail::VertexHandle Handle>
  Vertex(const Handle& v) : id_{v} {}

  operator VertexId() const { return id_; }

 private:
  VertexId id_;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
