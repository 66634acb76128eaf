// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <utility>
#include <variant>

namespace meshhood {

#if defined(MESHHOOD_NARROW_IDS)
// A build for tests alone, in which tiny meshes reach every limit on the number of vertices and edges.
using VertexId = std::uint16_t;
#else
/// A vertex, by its row in the caller's positions.
using VertexId = std::uint32_t;
#endif

/// The largest number of vertices: one id is kept free.
inline constexpr std::size_t kMaxVertices = std::numeric_limits<VertexId>::max() - std::size_t{1};

/// A contiguous range of `T` that may be borrowed: an lvalue or a view. A temporary container is neither, so that a
/// view of one does not compile.
template <class Range, class T>
concept BorrowedArray = std::ranges::borrowed_range<Range> && std::convertible_to<Range, std::span<const T>>;

/// Positions of the vertices, `#V by 3`, row after row, float or double, in any unit. Borrowed, never copied.
class PositionsView {
 public:
  PositionsView() = default;

  template <std::convertible_to<std::span<const float>> Range>
  PositionsView(const Range& xyz) : xyz_(std::span<const float>(xyz)) {}

  template <std::convertible_to<std::span<const double>> Range>
  PositionsView(const Range& xyz) : xyz_(std::span<const double>(xyz)) {}

  /// Calls `f` with the `std::span<const float>` or `std::span<const double>` behind this view and returns its result.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), xyz_);
  }

  /// The number of scalars: `3 #V` for a view that `validate` accepts.
  [[nodiscard]] std::size_t scalar_count() const {
    return visit([](auto xyz) { return xyz.size(); });
  }

  /// #V.
  [[nodiscard]] std::size_t size() const { return scalar_count() / 3; }

 private:
  std::variant<std::span<const float>, std::span<const double>> xyz_;
};

/// A list of indices of 32 or 64 bits, signed or not. Borrowed, never copied. A negative index is out of range.
class IndicesView {
 public:
  IndicesView() = default;

  template <std::convertible_to<std::span<const std::uint32_t>> Range>
  IndicesView(const Range& indices) : indices_(std::span<const std::uint32_t>(indices)) {}

  template <std::convertible_to<std::span<const std::int32_t>> Range>
  IndicesView(const Range& indices) : indices_(std::span<const std::int32_t>(indices)) {}

  template <std::convertible_to<std::span<const std::uint64_t>> Range>
  IndicesView(const Range& indices) : indices_(std::span<const std::uint64_t>(indices)) {}

  template <std::convertible_to<std::span<const std::int64_t>> Range>
  IndicesView(const Range& indices) : indices_(std::span<const std::int64_t>(indices)) {}

  /// Calls `f` with the span behind this view and returns its result.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), indices_);
  }

  [[nodiscard]] std::size_t size() const {
    return visit([](auto indices) { return indices.size(); });
  }

 private:
  std::variant<std::span<const std::uint32_t>, std::span<const std::int32_t>, std::span<const std::uint64_t>,
               std::span<const std::int64_t>>
      indices_;
};

/// The polygons of a mesh: triangles as `#F by 3` corners, or polygons of any size as offsets and corners.
///
/// The **graph** of a mesh joins the consecutive distinct corners of each polygon, the last with the first. A polygon
/// of two corners is therefore an edge; one of a single corner, or of none, joins nothing. Nothing is assumed manifold,
/// closed, connected or oriented; sheets that share a vertex are joined there.
class FacesView {
 public:
  FacesView() = default;

  /// `corners`: #F by 3, row after row.
  [[nodiscard]] static FacesView triangles(IndicesView corners) { return FacesView({}, corners, true); }

  /// Polygon `f` has the corners `corners[offsets[f]] .. corners[offsets[f + 1] - 1]`.
  /// `offsets`: #F + 1, ascending from 0 to `corners.size()`; empty where there are no faces.
  [[nodiscard]] static FacesView polygons(IndicesView offsets, IndicesView corners) {
    return FacesView(offsets, corners, false);
  }

  /// #F.
  [[nodiscard]] std::size_t size() const {
    if (triangles_) return corners_.size() / 3;
    return offsets_.size() == 0 ? 0 : offsets_.size() - 1;
  }

  [[nodiscard]] bool are_triangles() const { return triangles_; }
  [[nodiscard]] const IndicesView& offsets() const { return offsets_; }
  [[nodiscard]] const IndicesView& corners() const { return corners_; }

  /// Calls `f(face, corners)` for every face in order, `corners` a span of the caller's index type.
  /// The view must have passed `validate`.
  template <class F>
  void for_each(F&& f) const {
    corners_.visit([&](auto corners) {
      if (triangles_) {
        for (std::size_t face = 0; face < corners.size() / 3; ++face) f(face, corners.subspan(3 * face, 3));
        return;
      }
      offsets_.visit([&](auto offsets) {
        for (std::size_t face = 0; face + 1 < offsets.size(); ++face) {
          const auto begin = static_cast<std::size_t>(offsets[face]);
          const auto end = static_cast<std::size_t>(offsets[face + 1]);
          f(face, corners.subspan(begin, end - begin));
        }
      });
    });
  }

 private:
  FacesView(IndicesView offsets, IndicesView corners, bool triangles)
      : offsets_(offsets), corners_(corners), triangles_(triangles) {}

  IndicesView offsets_;
  IndicesView corners_;
  bool triangles_ = true;
};

/// A polygonal mesh, borrowed from the caller, who keeps the arrays alive and unchanged during the call it is given to.
struct MeshView {
  PositionsView positions;
  FacesView faces;
};

/// Throws unless `mesh` describes a mesh: positions `#V by 3`, finite, and no double beyond 2^500 in size (its square
/// would overflow); `3 #F` corners, or offsets that ascend from 0 to the number of corners; every corner in [0, #V).
/// Degenerate, repeated and isolated elements are accepted. Everything that takes a `MeshView` calls this first.
///
/// Throws Error{InvalidMesh, TooLarge}, naming the vertex, or the face and corner. O(#V + #corners).
void validate(const MeshView& mesh);

/// Throws unless every coordinate is as `validate(const MeshView&)` asks.
void validate(const PositionsView& positions);

/// The distance between two vertices, as every search computes it: in double, `sqrt((dx*dx + dy*dy) + dz*dz)`.
/// A vertex lies in the ball around `v` whose radius is exactly `distance(positions, v, w)`.
///
/// Throws Error{VertexOutOfRange}.
[[nodiscard]] double distance(const PositionsView& positions, VertexId v, VertexId w);

}  // namespace meshhood
