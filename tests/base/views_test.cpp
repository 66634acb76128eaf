// SPDX-License-Identifier: MIT
// Views of positions and faces in every layout give the same index; views of temporaries do not compile.
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/eigen.h"
#include "meshhood/io/mesh_io.h"
#include "meshhood/meshhood.h"

#include "support/index_bytes.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

template <class T>
concept MakesTriangles = requires(T&& corners) { FacesView::triangles(std::forward<T>(corners)); };
template <class T>
concept HasView = requires(T&& owner) { std::forward<T>(owner).view(); };
template <class T>
concept HasPositions = requires(T&& owner) { std::forward<T>(owner).positions(); };
template <class T>
concept HasPermutation = requires(T&& owner) { std::forward<T>(owner).permutation(); };
template <class T>
concept HasAdjacency = requires(T&& owner) { std::forward<T>(owner).adjacency(); };
template <class T>
concept HasProfile = requires(T&& owner) { std::forward<T>(owner).profile(); };
template <class T>
concept HasList = requires(T&& owner) { std::forward<T>(owner).list(); };
template <class T>
concept HasScales = requires(T&& owner) { std::forward<T>(owner).scales(); };
template <class T>
concept HasCenter = requires(T&& owner) { std::forward<T>(owner).center(); };
template <class T>
concept HasFace = requires(T&& owner) { std::forward<T>(owner).face(); };
template <class T>
concept HasPoint = requires(T&& owner) { std::forward<T>(owner).point(); };
template <class T>
concept HasRanges = requires(T&& owner) { std::forward<T>(owner).ranges(VertexId{0}, 1.0); };

// Containers that outlive the view, and views of them.
static_assert(std::constructible_from<PositionsView, std::vector<float>&>);
static_assert(std::constructible_from<PositionsView, const std::vector<double>&>);
static_assert(std::constructible_from<PositionsView, const std::array<float, 9>&>);
static_assert(std::constructible_from<PositionsView, const float (&)[9]>);  // NOLINT(modernize-avoid-c-arrays)
static_assert(std::constructible_from<PositionsView, std::span<const float>>);
static_assert(std::constructible_from<PositionsView, std::span<double>>);
static_assert(std::constructible_from<PositionsView, const std::vector<std::array<float, 3>>&>);
static_assert(std::constructible_from<PositionsView, std::span<const std::array<double, 3>>>);
static_assert(MakesTriangles<const std::vector<std::int32_t>&>);
static_assert(MakesTriangles<std::span<const std::uint64_t>>);
static_assert(MakesTriangles<const std::vector<std::array<std::uint32_t, 3>>&>);

// What an object owns is not viewed through a temporary.
static_assert(HasPositions<const Index&> && !HasPositions<Index>);
static_assert(HasPositions<const paper::Index&> && !HasPositions<paper::Index>);
static_assert(HasPermutation<const Index&> && !HasPermutation<Index>);
static_assert(HasPermutation<const paper::Index&> && !HasPermutation<paper::Index>);
static_assert(HasPermutation<Searcher&> && !HasPermutation<Searcher>);
static_assert(HasPermutation<paper::Searcher&> && !HasPermutation<paper::Searcher>);
static_assert(HasRanges<Searcher&> && !HasRanges<Searcher>);
static_assert(HasRanges<paper::Searcher&> && !HasRanges<paper::Searcher>);
static_assert(HasRanges<ReferenceSearcher&> && !HasRanges<ReferenceSearcher>);
static_assert(HasRanges<BallSearcher&> && !HasRanges<BallSearcher>);
static_assert(HasAdjacency<const ReferenceSearcher&> && !HasAdjacency<ReferenceSearcher>);
static_assert(HasProfile<const paper::Searcher&> && !HasProfile<paper::Searcher>);
static_assert(HasList<const BatchVertices&> && !HasList<BatchVertices>);
static_assert(HasList<const BatchRadius&> && !HasList<BatchRadius>);
static_assert(HasScales<const BatchRadius&> && !HasScales<BatchRadius>);
static_assert(HasCenter<const Start&> && !HasCenter<Start>);
static_assert(HasFace<const PatchStart&> && !HasFace<PatchStart>);
static_assert(HasPoint<const PatchStart&> && !HasPoint<PatchStart>);

// A bool is no radius.
template <class R>
concept IsRadius = requires(Searcher searcher, std::vector<VertexId> ids, R radius) {
  searcher.neighborhood(0, radius, ids);
  searcher.count(0, radius);
  searcher.contains(0, 1, radius);
  BatchRadius(radius);
};
static_assert(IsRadius<double> && IsRadius<float> && IsRadius<int> && IsRadius<std::uint64_t>);

template <class R>
concept IsRadiusAnywhere = requires(Searcher searcher, R radius) { searcher.count(0, radius); } ||
                           requires(Searcher searcher, R radius) { searcher.neighborhood(0, radius); } ||
                           requires(Searcher searcher, R radius) { searcher.ranges(0, radius); } ||
                           requires(Searcher searcher, R radius) { searcher.has_seed(0, radius); } ||
                           requires(Searcher searcher, R radius) { searcher.contains(0, 1, radius); } ||
                           requires(R radius) { Dab{0, radius}; } || requires(R radius) { BatchRadius(radius); };
static_assert(!IsRadiusAnywhere<bool>);

// Each field and parameter that borrows takes a container that lives, and a view of one, but no temporary.
template <class T>
constexpr bool kIsBorrowed = std::constructible_from<T, const std::vector<typename T::value_type>&> &&
                             std::constructible_from<T, std::span<const typename T::value_type>> &&
                             std::constructible_from<T, std::span<typename T::value_type>> &&
                             !std::constructible_from<T, std::vector<typename T::value_type>> &&
                             !std::constructible_from<T, std::array<typename T::value_type, 3>>;
static_assert(kIsBorrowed<decltype(SignalView::weights)>);
static_assert(kIsBorrowed<decltype(MomentOptions::weights)>);
static_assert(kIsBorrowed<decltype(FeatureOptions::areas)>);
static_assert(kIsBorrowed<decltype(AdjacencyView::offsets)>);
static_assert(kIsBorrowed<decltype(AdjacencyView::neighbors)>);
static_assert(kIsBorrowed<decltype(io::VertexProperty::values)>);
static_assert(kIsBorrowed<decltype(io::PlyOptions::colors)>);
static_assert(std::constructible_from<ValuesView, const std::vector<float>&>);
static_assert(!std::constructible_from<ValuesView, std::vector<float>>);
struct Handle {
  explicit(false) operator VertexId() const { return 3; }
};
struct Coordinate {
  explicit(false) operator float() const { return 3; }
};
template <class T>
constexpr bool kIsMadeOfVertices =
    std::convertible_to<int, T> && std::convertible_to<std::size_t, T> && std::convertible_to<Handle, T> &&
    !std::constructible_from<T, bool> && !std::constructible_from<T, std::vector<bool>::reference> &&
    !std::constructible_from<T, double> && !std::constructible_from<T, Coordinate>;
static_assert(kIsMadeOfVertices<Vertex> && kIsMadeOfVertices<Start> && kIsMadeOfVertices<PatchStart>);
static_assert(std::constructible_from<Start, SpacePoint, const std::vector<VertexId>&>);
static_assert(!std::constructible_from<Start, SpacePoint, std::vector<VertexId>>);
static_assert(std::constructible_from<AdjacencyView, std::vector<EdgeOffset>&, std::vector<VertexId>&>);
static_assert(!std::constructible_from<AdjacencyView, std::vector<EdgeOffset>, std::vector<VertexId>&>);
static_assert(!std::constructible_from<AdjacencyView, std::vector<EdgeOffset>&, std::vector<VertexId>>);
static_assert(std::constructible_from<VertexMask, const std::array<bool, 3>&>);
static_assert(std::constructible_from<VertexMask, std::span<const bool>>);
static_assert(!std::constructible_from<VertexMask, std::array<bool, 3>>);
static_assert(!std::constructible_from<VertexMask, std::vector<bool>>);
static_assert(!std::constructible_from<VertexMask, std::vector<std::uint8_t>>);
static_assert(!std::constructible_from<BatchVertices, std::vector<VertexId>>);
static_assert(!std::constructible_from<BatchRadius, std::vector<double>>);
static_assert(std::constructible_from<BatchRadius, int> && !std::constructible_from<BatchRadius, bool>);

// Indices of each width, the rows of other libraries, and rows with more than three scalars.
struct Padded {
  float x[4];  // NOLINT(modernize-avoid-c-arrays)
  float& operator[](int i) { return x[i]; }
  const float& operator[](int i) const { return x[i]; }
};
static_assert(MakesTriangles<const std::vector<short>&> && MakesTriangles<const std::vector<unsigned short>&>);
static_assert(MakesTriangles<const std::vector<long>&> && MakesTriangles<const std::vector<long long>&>);
static_assert(MakesTriangles<const std::vector<unsigned long long>&>);
static_assert(MakesTriangles<const int (&)[5][3]>);                             // NOLINT(modernize-avoid-c-arrays)
static_assert(std::constructible_from<PositionsView, const double (&)[5][3]>);  // NOLINT(modernize-avoid-c-arrays)
static_assert(!std::constructible_from<PositionsView, const std::vector<Padded>&>);
static_assert(!MakesTriangles<const std::vector<std::array<int, 4>>&>);
// A vector has the size of three doubles or long integers, and so has a view with a stride.
struct StridedView {
  const double* first;
  std::size_t size;
  std::size_t stride;
  const double& operator[](std::size_t i) const { return first[i * stride]; }
};
static_assert(sizeof(StridedView) != 3 * sizeof(double) ||
              !std::constructible_from<PositionsView, const std::vector<StridedView>&>);
static_assert(!std::constructible_from<PositionsView, const std::vector<std::vector<double>>&>);
static_assert(!MakesTriangles<const std::vector<std::vector<std::int64_t>>&>);
static_assert(!MakesTriangles<const std::vector<char>&> && !MakesTriangles<const std::vector<bool>&>);

// Temporaries.
static_assert(!std::constructible_from<PositionsView, std::vector<float>>);
static_assert(!std::constructible_from<PositionsView, const std::vector<float>>);
static_assert(!std::constructible_from<PositionsView, std::array<double, 9>>);
static_assert(!std::constructible_from<PositionsView, std::vector<std::array<float, 3>>>);
static_assert(!std::constructible_from<IndicesView, std::vector<std::int32_t>>);
static_assert(!MakesTriangles<std::vector<std::uint32_t>>);
static_assert(!MakesTriangles<std::vector<std::array<std::uint32_t, 3>>>);
static_assert(!std::constructible_from<Searcher, Index>);
static_assert(!std::constructible_from<paper::Searcher, paper::Index>);
static_assert(!std::constructible_from<SearchMethod, Index>);
static_assert(!std::constructible_from<SearchMethod, paper::Index>);
static_assert(HasView<const Adjacency&> && !HasView<Adjacency>);
static_assert(HasView<const GraphData&> && !HasView<GraphData>);
static_assert(HasView<const ReorderedMesh&> && !HasView<ReorderedMesh>);

// A radius of any arithmetic type.
static_assert(std::constructible_from<BatchRadius, float>);
static_assert(std::constructible_from<BatchRadius, const std::vector<double>&>);

/// Numbers as rows of three.
template <class Scalar>
std::vector<std::array<Scalar, 3>> rows_of(const auto& flat) {
  std::vector<std::array<Scalar, 3>> rows;
  for (std::size_t i = 0; i < flat.size(); i += 3) {
    rows.push_back({static_cast<Scalar>(flat[i]), static_cast<Scalar>(flat[i + 1]), static_cast<Scalar>(flat[i + 2])});
  }
  return rows;
}

/// A mesh in the plain layout, row by row, and the bytes of its index.
class Views : public testing::Test {
 protected:
  void expect_same(const MeshView& view) const {
    EXPECT_NO_THROW(validate(view));
    EXPECT_EQ(saved(build(view)), saved(index_));
    EXPECT_EQ(saved(paper::build(view)), saved(paper::build(plain_)));
    EXPECT_EQ(fingerprint(view), fingerprint(plain_));
    EXPECT_THAT(index_.check(view), testing::IsEmpty());
    EXPECT_EQ(distance(view.positions, 3, 40), distance(plain_.positions, 3, 40));
    std::vector<VertexId> expected;
    std::vector<VertexId> found;
    BallSearcher(plain_.positions).neighborhood(7, 2.5, expected);
    BallSearcher(view.positions).neighborhood(7, 2.5, found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(exact_neighborhood(view, 7, 2.5), exact_neighborhood(plain_, 7, 2.5));
  }

  static constexpr std::size_t kWidth = 12;

  std::vector<double> xyz_ = [] {
    std::vector<double> result;
    for (std::size_t v = 0; v < kWidth * kWidth; ++v) {
      const std::size_t row = v / kWidth;
      const auto x = static_cast<double>(v - row * kWidth);
      const auto y = static_cast<double>(row);
      result.insert(result.end(), {x, y, 0.1 * x * y});
    }
    return result;
  }();
  std::vector<std::int32_t> corners_ = [] {
    std::vector<std::int32_t> result;
    constexpr std::int32_t kRow = kWidth;
    for (std::int32_t v = 0; v + kRow + 1 < kRow * kRow; ++v) {
      if (v % kRow + 1 < kRow) result.insert(result.end(), {v, v + 1, v + kRow, v + 1, v + kRow + 1, v + kRow});
    }
    return result;
  }();
  MeshView plain_{xyz_, FacesView::triangles(corners_)};
  Index index_ = build(plain_);

  /// Entry `(row, axis)` of a matrix with three columns is moved to where `place(row, axis)` says.
  template <class T, class Place>
  static std::vector<T> moved(const std::vector<T>& rows, std::size_t size, Place place) {
    std::vector<T> result(size, T{99});
    for (std::size_t i = 0; i < rows.size(); ++i) result[place(i / 3, i % 3)] = rows[i];
    return result;
  }
};

TEST_F(Views, OfArraysOfThreeAreRead) {
  const auto points = rows_of<double>(xyz_);
  const auto triangles = rows_of<std::int32_t>(corners_);
  expect_same({points, FacesView::triangles(triangles)});
}

/// `build` of flat corners, and of triangles, of one type.
template <class T>
void expect_built_from(const std::vector<double>& xyz, const std::vector<std::int32_t>& corners, const Index& index) {
  const std::vector<T> flat(corners.begin(), corners.end());
  EXPECT_EQ(saved(build(xyz, flat)), saved(index));
  EXPECT_EQ(saved(build(rows_of<double>(xyz), rows_of<T>(corners), {.threads = 2})), saved(index));
}

TEST_F(Views, AreMadeByBuildFromArraysOfEachType) {
  expect_built_from<short>(xyz_, corners_, index_);
  expect_built_from<unsigned short>(xyz_, corners_, index_);
  expect_built_from<int>(xyz_, corners_, index_);
  expect_built_from<unsigned>(xyz_, corners_, index_);
  expect_built_from<long>(xyz_, corners_, index_);
  expect_built_from<unsigned long>(xyz_, corners_, index_);
  expect_built_from<long long>(xyz_, corners_, index_);
  expect_built_from<unsigned long long>(xyz_, corners_, index_);
  EXPECT_EQ(saved(build(PositionsView(xyz_), plain_.faces)), saved(index_));
  const std::vector<short> negative{0, 1, -2};
  expect_refused(ErrorCode::InvalidMesh, "face 0: corner 2 is vertex -2", [&] { return build(xyz_, negative); });
}

TEST_F(Views, OfColumnsAreRead) {
  const std::size_t vertices = xyz_.size() / 3;
  const std::size_t faces = corners_.size() / 3;
  const auto columns =
      moved(xyz_, xyz_.size(), [&](std::size_t row, std::size_t axis) { return axis * vertices + row; });
  const auto triangles =
      moved(corners_, corners_.size(), [&](std::size_t row, std::size_t axis) { return axis * faces + row; });
  expect_same({PositionsView::column_major(columns), FacesView::column_major_triangles(triangles)});
}

TEST_F(Views, OfRecordsWithOtherFieldsAreRead) {
  const auto records =
      moved(xyz_, 2 * xyz_.size() + 1, [](std::size_t row, std::size_t axis) { return 6 * row + axis + 1; });
  const auto triangles =
      moved(corners_, 2 * corners_.size(), [](std::size_t row, std::size_t axis) { return 6 * row + 2 * axis; });
  expect_same({PositionsView::strided(records.data() + 1, xyz_.size() / 3, 6),
               FacesView::strided_triangles(triangles, corners_.size() / 3, 6, 2)});
}

TEST_F(Views, OfNoElementsAreEmpty) {
  const std::vector<float> none;
  const std::vector<std::array<float, 3>> no_points;
  const std::vector<std::array<std::int32_t, 3>> no_triangles;
  for (const PositionsView& positions :
       {PositionsView(none), PositionsView(no_points), PositionsView::column_major(none),
        PositionsView::strided(none.data(), 0, 7)}) {
    EXPECT_EQ(positions.size(), 0U);
    EXPECT_EQ(build(MeshView{positions, FacesView::triangles(no_triangles)}).vertex_count(), 0U);
  }
}

TEST_F(Views, NameTheVertexThatIsInvalidInEveryLayout) {
  const std::size_t vertices = xyz_.size() / 3;
  xyz_[3 * 5 + 1] = std::numeric_limits<double>::infinity();
  const auto columns =
      moved(xyz_, xyz_.size(), [&](std::size_t row, std::size_t axis) { return axis * vertices + row; });
  for (const PositionsView& positions : {PositionsView(xyz_), PositionsView::column_major(columns)}) {
    expect_refused(ErrorCode::InvalidMesh, "vertex 5: y is inf", [&] { validate(positions); });
  }
}

TEST_F(Views, RefuseArraysThatAreTooShort) {
  const std::vector<float> seven(7);
  expect_refused(ErrorCode::InvalidMesh, "7 coordinates, expected three a vertex",
                 [&] { validate(PositionsView::column_major(seven)); });
  const std::vector<std::int32_t> four(4);
  expect_refused(ErrorCode::InvalidMesh, "4 corner",
                 [&] { validate(MeshView{plain_.positions, FacesView::column_major_triangles(four)}); });
  expect_refused(ErrorCode::InvalidMesh, "2 triangles with strides 3 and 1 exceed the 4 corner indices",
                 [&] { validate(MeshView{plain_.positions, FacesView::strided_triangles(four, 2, 3, 1)}); });
  expect_refused(ErrorCode::InvalidMesh, "1 triangles with strides 0 and 2 exceed the 4 corner indices",
                 [&] { validate(MeshView{plain_.positions, FacesView::strided_triangles(four, 1, 0, 2)}); });
}

TEST_F(Views, AcceptAnIntegerRadius) {
  EXPECT_EQ(neighborhoods(index_, {.radius = 2}).ids, neighborhoods(index_, {.radius = 2.0}).ids);
  EXPECT_EQ(neighborhoods(index_, {.radius = 2}).ids, neighborhoods(index_, {.radius = 2.0F}).ids);
  expect_refused(ErrorCode::InvalidRadius, "radius -3", [&] { return neighborhoods(index_, {.radius = -3}); });
}

#if __has_include(<Eigen/Core>)
template <class M>
concept ViewedAsPositions = requires(M&& matrix) { positions_view(std::forward<M>(matrix)); };

static_assert(ViewedAsPositions<const Eigen::MatrixXd&>);
static_assert(ViewedAsPositions<Eigen::Map<const Eigen::MatrixXf>>);
static_assert(!ViewedAsPositions<Eigen::MatrixXd>);
static_assert(ViewedAsPositions<Eigen::Ref<Eigen::MatrixXd>> && !ViewedAsPositions<Eigen::Ref<const Eigen::MatrixXd>>);
// If a matrix is passed as an array, the order of its entries is lost.
static_assert(!std::constructible_from<PositionsView, const Eigen::MatrixXd&>);
static_assert(!MakesTriangles<const Eigen::MatrixXi&>);

TEST_F(Views, OfMatricesOfEigenAreReadInBothOrders) {
  using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowMajorXi = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const RowMajorXd rows = Eigen::Map<const RowMajorXd>(xyz_.data(), static_cast<Eigen::Index>(xyz_.size() / 3), 3);
  const RowMajorXi row_faces =
      Eigen::Map<const RowMajorXi>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
  const Eigen::MatrixXd columns = rows;
  const Eigen::MatrixXi column_faces = row_faces;
  expect_same(mesh_view(rows, row_faces));
  expect_same(mesh_view(columns, column_faces));
  const Eigen::Ref<const Eigen::MatrixXd> positions = columns;
  const Eigen::Ref<const Eigen::MatrixXi> faces = column_faces;
  expect_same(mesh_view(positions, faces));
  const Eigen::Matrix3Xd transposed = rows.transpose();
  expect_same(mesh_view(transposed.transpose(), column_faces));
  const Eigen::MatrixX<std::int64_t> wide = column_faces.cast<std::int64_t>();
  expect_same(mesh_view(columns, wide));
}

TEST_F(Views, OfVectorsOfEigenAreReadAsRows) {
  std::vector<Eigen::RowVector3d> points;
  for (const auto& p : rows_of<double>(xyz_)) points.emplace_back(p[0], p[1], p[2]);
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& t : rows_of<int>(corners_)) triangles.emplace_back(t[0], t[1], t[2]);
  expect_same({points, FacesView::triangles(triangles)});
  EXPECT_EQ(saved(build(points, triangles)), saved(index_));
}

TEST_F(Views, OfBlocksOfMatricesAreRead) {
  Eigen::MatrixXd larger(static_cast<Eigen::Index>(xyz_.size() / 3) + 4, 8);
  larger.setConstant(99);
  auto block = larger.block(2, 3, static_cast<Eigen::Index>(xyz_.size() / 3), 3);
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) block(i, axis) = xyz_[static_cast<std::size_t>(3 * i + axis)];
  }
  expect_same({positions_view(block), plain_.faces});
}

TEST_F(Views, OfMatricesWithoutThreeColumnsAreRefused) {
  const Eigen::MatrixXd flat(5, 2);
  const Eigen::MatrixXi quads(5, 4);
  expect_refused(ErrorCode::InvalidMesh, "V has 2 columns, expected 3", [&] { return positions_view(flat); });
  expect_refused(ErrorCode::InvalidMesh, "F has 4 columns, expected 3", [&] { return triangles_view(quads); });
}
#endif

}  // namespace
}  // namespace meshhood::test
