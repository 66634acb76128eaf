// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>  // also for concepts of ranges, which its constructors require; <ranges> takes twice the time
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/vertex.h"
#include "meshhood/vertex_id.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The largest number of vertices of a mesh. One id is reserved.
inline constexpr std::size_t kMaxVertices = (std::numeric_limits<VertexId>::max)() - std::size_t{1};

/// A contiguous range of `T` that may be borrowed: an lvalue or a view. A temporary container is neither, so that a
/// view of one does not compile.
template <class Range, class T>
concept BorrowedArray = std::ranges::borrowed_range<Range> && std::convertible_to<Range, std::span<const T>>;

/// Borrows a contiguous array, which must outlive this view. A temporary container is rejected by the compiler, as in
/// each field and parameter of this type.
template <class T>
class Borrowed : public std::span<const T> {
 public:
  constexpr Borrowed() = default;

  template <BorrowedArray<T> Range>
  constexpr Borrowed(Range&& array) : std::span<const T>(array) {}
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1

template <class T>
inline constexpr bool std::ranges::enable_borrowed_range<meshhood::Borrowed<T>> = true;

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A type of coordinates and values.
template <class T>
concept FloatOrDouble = std::same_as<T, float> || std::same_as<T, double>;

/// A type of indices: an integer of 16 to 64 bits.
template <class T>
concept IndexInteger = std::same_as<T, short> || std::same_as<T, unsigned short> || std::same_as<T, int> ||
                       std::same_as<T, unsigned> || std::same_as<T, long> || std::same_as<T, unsigned long> ||
                       std::same_as<T, long long> || std::same_as<T, unsigned long long>;

namespace detail {

/// The type of the elements of a range.
template <class Range>
using Element = std::ranges::range_value_t<Range>;

/// The type of `row[0]`.
template <class Row>
using Scalar = std::remove_cvref_t<decltype(std::declval<const Row&>()[0])>;

}  // namespace detail

/// Three scalars in a row and nothing else: `std::array<T, 3>`, `T[3]`, `Eigen::Vector3d`, `glm::vec3` and others. A
/// container or a view of that size holds its scalars elsewhere, and is rejected: a container has a destructor, and the
/// scalars of a view do not become constant with it, or it has no default.
template <class Row>
concept RowOfThree =
    requires(const Row& constant, Row& row) {
      { constant[0] } -> std::same_as<const detail::Scalar<Row>&>;
      { row[0] } -> std::same_as<detail::Scalar<Row>&>;
    } && sizeof(Row) == 3 * sizeof(detail::Scalar<Row>) && std::is_trivially_destructible_v<Row> &&
    std::default_initializable<Row>;

namespace detail {

/// Returns the scalars of rows of three, #rows by 3.
template <RowOfThree Row>
[[nodiscard]] std::span<const Scalar<Row>> flatten(std::span<const Row> rows) {
  if (rows.empty()) return {};
  return {&rows.front()[0], 3 * rows.size()};
}

}  // namespace detail

/// A contiguous range that may be borrowed: of float or double, or of points, each a row of three of them.
template <class Range>
concept BorrowedReals = BorrowedArray<Range, detail::Element<Range>> && FloatOrDouble<detail::Element<Range>>;
template <class Range>
concept BorrowedPoints = BorrowedArray<Range, detail::Element<Range>> && RowOfThree<detail::Element<Range>> &&
                         FloatOrDouble<detail::Scalar<detail::Element<Range>>>;

/// A contiguous range that may be borrowed: of indices, or of triangles, each a row of three of them.
template <class Range>
concept BorrowedIndices = BorrowedArray<Range, detail::Element<Range>> && IndexInteger<detail::Element<Range>>;
template <class Range>
concept BorrowedTriangles = BorrowedArray<Range, detail::Element<Range>> && RowOfThree<detail::Element<Range>> &&
                            IndexInteger<detail::Scalar<detail::Element<Range>>>;

/// Coordinate `axis` of vertex `v` is `first[v * vertex_stride + axis * axis_stride]`.
template <class Real>
struct StridedPositions {
  const Real* first = nullptr;
  std::size_t count = 0;          ///< #V
  std::size_t vertex_stride = 3;  ///< in elements, as the next
  std::size_t axis_stride = 1;

  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] Real operator()(std::size_t v, std::size_t axis) const {
    return first[v * vertex_stride + axis * axis_stride];
  }

  /// Returns whether the coordinates follow each other, vertex after vertex.
  [[nodiscard]] bool is_packed() const { return vertex_stride == 3 && axis_stride == 1; }

  /// Returns all coordinates of packed positions, #V by 3.
  [[nodiscard]] std::span<const Real> packed() const { return {first, 3 * count}; }
};

/// Borrows the positions of the vertices, #V by 3, float or double, in any unit: nothing is copied, and the memory must
/// outlive the view. A temporary container is rejected by the compiler.
///
/// A flat array and an array of points (see `RowOfThree`) are read row by row: x, y, z of vertex 0, then of vertex 1.
/// For other layouts use `column_major`, `strided`, or `meshhood/eigen.h` for matrices of Eigen.
class PositionsView {
 public:
  PositionsView() = default;

  /// Takes a flat array of 3 #V coordinates, row by row.
  template <BorrowedReals Range>
  PositionsView(Range&& xyz) : PositionsView(Rows{}, std::span<const detail::Element<Range>>(xyz)) {}

  /// Takes one point for each vertex.
  template <BorrowedPoints Range>
  PositionsView(Range&& points)
      : PositionsView(Rows{}, detail::flatten(std::span<const detail::Element<Range>>(points))) {}

  /// Takes a flat array of all x, then all y, then all z.
  template <BorrowedReals Range>
  [[nodiscard]] static PositionsView column_major(Range&& xyz) {
    const std::span<const detail::Element<Range>> all(xyz);
    PositionsView view = strided(all.data(), all.size() / 3, 1, all.size() / 3);
    view.scalars_ = all.size();
    return view;
  }

  /// Coordinate `axis` of vertex `v` is `first[v * vertex_stride + axis * axis_stride]`; strides are in elements. Use
  /// it for positions inside larger records: `strided(&points[0].x, points.size(), sizeof(Point) / sizeof(float))`.
  template <FloatOrDouble Real>
  [[nodiscard]] static PositionsView strided(const Real* first, std::size_t count, std::size_t vertex_stride,
                                             std::size_t axis_stride = 1) {
    return {StridedPositions<Real>{first, count, vertex_stride, axis_stride}, 3 * count};
  }

  /// Calls `f` with the `StridedPositions<float>` or `StridedPositions<double>` behind this view, and returns its
  /// result.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), positions_);
  }

  /// Returns the number of scalars given: `3 #V` for a view that `validate` accepts.
  [[nodiscard]] std::size_t scalar_count() const { return scalars_; }

  /// Returns #V.
  [[nodiscard]] std::size_t size() const { return scalars_ / 3; }

 private:
  template <class Real>
  PositionsView(StridedPositions<Real> positions, std::size_t scalars) : positions_(positions), scalars_(scalars) {}

  struct Rows {};

  template <class Real>
  PositionsView(Rows, std::span<const Real> xyz)
      : PositionsView(StridedPositions<Real>{xyz.data(), xyz.size() / 3}, xyz.size()) {}

  std::variant<StridedPositions<float>, StridedPositions<double>> positions_;
  std::size_t scalars_ = 0;
};

/// Borrows a list of indices of 16 to 64 bits, signed or not: nothing is copied, and the memory must outlive the view.
/// A temporary container is rejected by the compiler. A negative index is out of range.
class IndicesView {
 public:
  IndicesView() = default;

  template <BorrowedIndices Range>
  IndicesView(Range&& indices) : indices_(std::span<const detail::Element<Range>>(indices)) {}

  /// Calls `f` with the span behind this view and returns its result.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), indices_);
  }

  [[nodiscard]] std::size_t size() const {
    return visit([](auto indices) { return indices.size(); });
  }

  /// Returns index `i` as unsigned: a negative one becomes larger than any number of vertices.
  [[nodiscard]] std::uint64_t operator[](std::size_t i) const {
    return visit([i](auto indices) { return static_cast<std::uint64_t>(indices[i]); });
  }

 private:
  std::variant<std::span<const unsigned>, std::span<const int>, std::span<const unsigned short>, std::span<const short>,
               std::span<const unsigned long>, std::span<const long>, std::span<const unsigned long long>,
               std::span<const long long>>
      indices_;
};

/// Borrows the polygons of a mesh: triangles, #F by 3, or polygons of any size as offsets and corners.
///
/// The **graph** of a mesh joins the consecutive distinct corners of each polygon, the last with the first. A polygon
/// of two corners is therefore an edge; a polygon of one corner, or of none, joins nothing. Nothing is assumed
/// manifold, closed, connected or oriented. Sheets that share a vertex are connected there.
class FacesView {
 public:
  FacesView() = default;

  /// Takes triangles, row by row: `corners` is #F by 3.
  [[nodiscard]] static FacesView triangles(IndicesView corners) {
    return strided_triangles(corners, corners.size() / 3, 3, 1);
  }

  /// Takes one row of three corners for each triangle.
  template <BorrowedTriangles Range>
  [[nodiscard]] static FacesView triangles(Range&& corners) {
    return triangles(detail::flatten(std::span<const detail::Element<Range>>(corners)));
  }

  /// Takes triangles in a flat array of all first corners, then all second, then all third.
  [[nodiscard]] static FacesView column_major_triangles(IndicesView corners) {
    return strided_triangles(corners, corners.size() / 3, 1, corners.size() / 3);
  }

  /// Corner `i` of triangle `f` is `corners[f * face_stride + i * corner_stride]`, for `count` triangles. The face
  /// stride is at least 1 if there are several.
  [[nodiscard]] static FacesView strided_triangles(IndicesView corners, std::size_t count, std::size_t face_stride,
                                                   std::size_t corner_stride) {
    FacesView faces;
    faces.corners_ = corners;
    faces.count_ = count;
    faces.face_stride_ = face_stride;
    faces.corner_stride_ = corner_stride;
    return faces;
  }

  /// Polygon `f` has the corners `corners[offsets[f]] .. corners[offsets[f + 1] - 1]`. `offsets` has #F + 1 numbers,
  /// ascending from 0 to `corners.size()`; it may be empty if there are no faces.
  [[nodiscard]] static FacesView polygons(IndicesView offsets, IndicesView corners) {
    FacesView faces;
    faces.triangles_ = false;
    faces.offsets_ = offsets;
    faces.corners_ = corners;
    faces.count_ = offsets.size() == 0 ? 0 : offsets.size() - 1;
    return faces;
  }

  /// Returns #F.
  [[nodiscard]] std::size_t size() const { return count_; }

  [[nodiscard]] bool are_triangles() const { return triangles_; }

  /// Returns the number of corners of all faces, once they have passed `validate`.
  [[nodiscard]] std::size_t corner_count() const { return are_triangles() ? 3 * count_ : corners_.size(); }

  /// Return the arrays as given. Use `for_each` to read the faces: triangles may be strided.
  [[nodiscard]] IndicesView offsets() const { return offsets_; }
  [[nodiscard]] IndicesView corners() const { return corners_; }
  [[nodiscard]] std::size_t face_stride() const { return face_stride_; }      ///< of triangles, in elements
  [[nodiscard]] std::size_t corner_stride() const { return corner_stride_; }  ///< of triangles, in elements

  /// Calls `f(face, corners)` for every face in order; `corners` is a `std::span<const VertexId>` that is valid during
  /// the call. The view must have passed `validate`. Corners of 32 bits are copied only if strided.
  template <class F>
  void for_each(F&& f) const {
    for_each(0, count_, f);
  }

  /// Does the same for the faces `begin .. end - 1`.
  template <class F>
  void for_each(std::size_t begin, std::size_t end, F&& f) const {
    std::vector<VertexId> copy;
    if (!are_triangles()) {
      for (std::size_t face = begin; face < end; ++face) f(face, polygon(face, copy));
      return;
    }
    for (std::size_t face = begin; face < end;) {
      const std::span<const VertexId> all = triangles_from(face, copy);
      const std::size_t left = 3 * (end - face);
      const std::span<const VertexId> corners = all.first(all.size() < left ? all.size() : left);
      for (std::size_t i = 0; i < corners.size(); i += 3) f(face++, corners.subspan(i, 3));
    }
  }

 private:
  /// Returns the corners of one or more triangles from `face` on, #triangles by 3: as given where that is possible,
  /// otherwise converted into `copy`, some hundred triangles at a time.
  [[nodiscard]] std::span<const VertexId> triangles_from(std::size_t face, std::vector<VertexId>& copy) const;

  /// Returns the corners of a polygon: as given where that is possible, otherwise converted into `copy`.
  [[nodiscard]] std::span<const VertexId> polygon(std::size_t face, std::vector<VertexId>& copy) const;

  IndicesView offsets_;
  IndicesView corners_;
  std::size_t count_ = 0;
  bool triangles_ = true;
  std::size_t face_stride_ = 3;
  std::size_t corner_stride_ = 1;
};

/// Borrows a polygonal mesh: the caller keeps the arrays alive and unchanged during each call that takes the view.
struct MeshView {
  PositionsView positions;
  FacesView faces;
};

/// Throws unless `mesh` describes a mesh: positions #V by 3, finite, and at most 2^500 in magnitude, so that no square
/// of a distance overflows; 3 #F corners, or offsets that ascend from 0 to the number of corners; every corner in [0,
/// #V). Degenerate, repeated and isolated elements are accepted. Every function that takes a `MeshView` calls this
/// first.
///
/// Throws Error{InvalidMesh, TooLarge}, naming the vertex, or the face and corner. Takes O(#V + #corners).
void validate(const MeshView& mesh);

/// Throws unless the positions are #V by 3 and every coordinate is valid, as above. Takes O(#V).
void validate(const PositionsView& positions);

/// Returns the distance between two vertices, as every search computes it: in double, `sqrt((dx*dx + dy*dy) + dz*dz)`.
/// Vertex `w` lies in the ball around `v` whose radius is exactly `distance(positions, v, w)`.
///
/// Squares of distances below 2^-511 lose digits, and below 2^-538 they are 0. There a search compares these squares,
/// while smoothing weights divide distances: a vertex beyond the radius may count, with the weight at the radius.
///
/// Throws Error{VertexOutOfRange}.
[[nodiscard]] double distance(const PositionsView& positions, Vertex v, Vertex w);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
