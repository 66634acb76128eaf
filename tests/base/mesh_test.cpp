// SPDX-License-Identifier: MIT
#include "meshhood/mesh.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/validate.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<float> kThreePoints{0, 0, 0, 1, 0, 0, 0, 1, 0};

void expect_mesh_refused(const char* cause, const FacesView& faces) {
  expect_refused(ErrorCode::InvalidMesh, cause, [&] { validate(MeshView{kThreePoints, faces}); });
}

TEST(Views, HaveTheRightSizes) {
  const std::vector<double> positions(12, 0.0);
  const std::vector<std::int64_t> corners{0, 1, 2, 2, 1, 3};
  const std::vector<std::uint32_t> offsets{0, 2, 2, 6};
  EXPECT_EQ(PositionsView(positions).size(), 4U);
  EXPECT_EQ(PositionsView().size(), 0U);
  EXPECT_EQ(FacesView::triangles(corners).size(), 2U);
  EXPECT_EQ(FacesView::polygons(offsets, corners).size(), 3U);
  EXPECT_EQ(FacesView().size(), 0U);
}

/// All faces in order, each as a list of corners.
std::vector<std::vector<std::size_t>> listed(const FacesView& faces) {
  std::vector<std::vector<std::size_t>> result;
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    EXPECT_EQ(face, result.size());
    result.emplace_back(corners.begin(), corners.end());
  });
  return result;
}

template <class Index>
class IndexTypes : public testing::Test {};

using AllIndexTypes = testing::Types<std::uint32_t, std::int32_t, std::uint64_t, std::int64_t>;
TYPED_TEST_SUITE(IndexTypes, AllIndexTypes);

TYPED_TEST(IndexTypes, GiveTheSameTrianglesInEveryLayout) {
  const std::vector<TypeParam> rows{0, 1, 2, 2, 1, 0};
  const std::vector<TypeParam> columns{0, 2, 1, 1, 2, 0};
  const std::vector<TypeParam> records{0, 1, 2, 9, 2, 1, 0, 9};
  const auto expected = ElementsAre(ElementsAre(0, 1, 2), ElementsAre(2, 1, 0));
  EXPECT_THAT(listed(FacesView::triangles(rows)), expected);
  EXPECT_THAT(listed(FacesView::column_major_triangles(columns)), expected);
  EXPECT_THAT(listed(FacesView::strided_triangles(records, 2, 4, 1)), expected);
  const std::vector<TypeParam> interlaced{0, 9, 1, 2, 2, 1, 9, 0};
  EXPECT_THAT(listed(FacesView::strided_triangles(interlaced, 2, 3, 2)), expected);
}

TYPED_TEST(IndexTypes, GiveManyTrianglesInEveryLayout) {
  constexpr std::size_t kFaces = 1000;
  std::vector<std::vector<std::size_t>> expected;
  std::vector<TypeParam> rows;
  std::vector<TypeParam> columns(3 * kFaces);
  for (std::size_t face = 0; face < kFaces; ++face) {
    expected.push_back({2 * face, face + 1, face});
    for (std::size_t i = 0; i < 3; ++i) {
      rows.push_back(static_cast<TypeParam>(expected[face][i]));
      columns[i * kFaces + face] = rows.back();
    }
  }
  EXPECT_EQ(listed(FacesView::triangles(rows)), expected);
  EXPECT_EQ(listed(FacesView::column_major_triangles(columns)), expected);
}

TYPED_TEST(IndexTypes, GiveTheSamePolygons) {
  const std::vector<TypeParam> corners{0, 1, 2, 1, 0};
  const std::vector<TypeParam> ends{0, 2, 2, 5};
  const std::vector<std::uint32_t> other_ends{0, 2, 2, 5};
  const auto expected = ElementsAre(ElementsAre(0, 1), ElementsAre(), ElementsAre(2, 1, 0));
  EXPECT_THAT(listed(FacesView::polygons(ends, corners)), expected);
  EXPECT_THAT(listed(FacesView::polygons(other_ends, corners)), expected);
}

TYPED_TEST(IndexTypes, GiveNoFacesIfThereAreNone) {
  const std::vector<TypeParam> none;
  const std::vector<TypeParam> zero{0};
  const std::vector<TypeParam> zeros{0, 0, 0};
  EXPECT_THAT(listed(FacesView::triangles(none)), IsEmpty());
  EXPECT_THAT(listed(FacesView::column_major_triangles(none)), IsEmpty());
  EXPECT_THAT(listed(FacesView::polygons(none, none)), IsEmpty());
  EXPECT_THAT(listed(FacesView::polygons(zero, none)), IsEmpty());
  EXPECT_THAT(listed(FacesView::polygons(zeros, none)), ElementsAre(IsEmpty(), IsEmpty()));
}

TYPED_TEST(IndexTypes, OfTheSizeOfAVertexAreNotCopied) {
  const std::vector<TypeParam> corners{0, 1, 2, 2, 1, 0};
  const std::vector<std::uint32_t> offsets{0, 3, 6};
  for (const FacesView& faces : {FacesView::triangles(corners), FacesView::polygons(offsets, corners)}) {
    faces.for_each([&](std::size_t face, std::span<const VertexId> seen) {
      const void* const given = &corners[3 * face];
      EXPECT_EQ(seen.data() == given, sizeof(TypeParam) == sizeof(VertexId));
    });
  }
}

TYPED_TEST(IndexTypes, ReadAsUnsignedNumbersOf64Bits) {
  const std::vector<TypeParam> indices{7, static_cast<TypeParam>(-1)};
  const IndicesView view(indices);
  EXPECT_EQ(view[0], 7U);
  EXPECT_GT(view[1], kMaxVertices);
}

TEST(Validate, RefusesNonFiniteCoordinatesAndNamesTheVertex) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [value, text] : {std::pair(nan, "nan"), {infinity, "inf"}, {-infinity, "-inf"}}) {
    for (std::size_t i = 0; i < 9; ++i) {
      std::vector<double> wide(9, 0.0);
      wide[i] = value;
      const std::vector<float> narrow(wide.begin(), wide.end());
      const std::string cause = "vertex " + std::to_string(i / 3) + ": " + "xyz"[i % 3] + " is " + text;
      expect_refused(ErrorCode::InvalidMesh, cause, [&] { validate(PositionsView(wide)); });
      expect_refused(ErrorCode::InvalidMesh, cause, [&] { validate(MeshView{narrow, {}}); });
    }
  }
}

TEST(Validate, RefusesStridesWhoseProductsOverflow) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  const std::vector<std::int32_t> three(3);
  for (const auto& [count, face_stride, corner_stride] : {std::array{std::size_t{2}, kMost - 1, std::size_t{1}},
                                                          {std::size_t{1}, std::size_t{3}, kMost / 2 + 1},
                                                          {kMost / 2 + 2, std::size_t{2}, std::size_t{1}},
                                                          {kMost, kMost, kMost},
                                                          {kMost, std::size_t{1}, kMost}}) {
    expect_mesh_refused("exceed the 3 corner indices",
                        FacesView::strided_triangles(three, count, face_stride, corner_stride));
  }
  expect_mesh_refused((std::to_string(kMost) + " triangles with a face stride of 0, expected 1 or more").c_str(),
                      FacesView::strided_triangles(three, kMost, 0, 1));
  EXPECT_NO_THROW(validate(MeshView{kThreePoints, FacesView::strided_triangles(three, 1, kMost, 1)}));
}

TEST(Validate, RefusesDoublesWhoseSquareOverflows) {
  const double limit = std::ldexp(1.0, 500);
  const std::vector<double> widest{limit, -limit, 0.0};
  EXPECT_NO_THROW(validate(PositionsView(widest)));
  const std::vector<double> beyond{0, std::nextafter(limit, 1e300), 0};
  expect_refused(ErrorCode::InvalidMesh, "vertex 0: y is 3.27", [&] { validate(PositionsView(beyond)); });
}

TEST(Validate, RefusesAnIncompleteVertex) {
  const std::vector<float> positions(7, 0.0F);
  expect_refused(ErrorCode::InvalidMesh, "7 coordinates, expected three a vertex",
                 [&] { validate(PositionsView(positions)); });
}

TEST(Validate, RefusesAnIncompleteTriangle) {
  const std::vector<std::uint32_t> corners{0, 1, 2, 0};
  expect_mesh_refused("4 corners, expected three a triangle", FacesView::triangles(corners));
}

template <class Index>
void expect_corner_refused(Index corner, const std::string& text) {
  const std::vector<Index> corners{0, 1, 2, 0, corner, 1};
  const std::string cause = "face 1: corner 1 is vertex " + text + ", but the mesh has 3 vertices";
  expect_mesh_refused(cause.c_str(), FacesView::triangles(corners));
}

TEST(Validate, ACornerIsComparedBeforeItIsNarrowed) {
  expect_corner_refused<std::uint32_t>(3, "3");
  expect_corner_refused<std::uint32_t>(0xFFFFFFFF, "4294967295");
  expect_corner_refused<std::int32_t>(-1, "-1");
  expect_corner_refused<std::int32_t>(std::numeric_limits<std::int32_t>::min(), "-2147483648");
  expect_corner_refused<std::uint64_t>(std::uint64_t{1} << 32, "4294967296");
  expect_corner_refused<std::int64_t>(-1, "-1");
  expect_corner_refused<std::int64_t>(std::int64_t{1} << 32, "4294967296");
}

TEST(Validate, RefusesInconsistentOffsets) {
  const std::vector<std::uint32_t> corners{0, 1, 2};
  const auto expect = [&](const char* cause, const std::vector<std::int64_t>& offsets) {
    expect_mesh_refused(cause, FacesView::polygons(offsets, corners));
  };
  expect("face offsets are empty, but there are 3 corners", {});
  expect("face offsets begin with 1, expected 0", {1, 3});
  expect("face offsets begin with -1, expected 0", {-1, 3});
  expect("face 1 ends at corner 1, before it begins at 2", {0, 2, 1, 3});
  expect("face 0 ends at corner -5, before it begins at 0", {0, -5, 3});
  expect("face offsets end with 4, but there are 3 corners", {0, 4});
  expect("face offsets end with 2, but there are 3 corners", {0, 2});
  expect("face offsets end with 4294967299, but there are 3 corners", {0, (std::int64_t{1} << 32) + 3});
}

TEST(Validate, AcceptsDegenerateMeshes) {
  const std::vector<std::uint32_t> corners{0, 0, 0, 1, 2, 1, 2};
  const std::vector<std::uint32_t> offsets{0, 0, 1, 3, 7};
  EXPECT_NO_THROW(validate(MeshView{kThreePoints, FacesView::polygons(offsets, corners)}));
  EXPECT_NO_THROW(validate(MeshView{}));
  EXPECT_NO_THROW(validate(MeshView{kThreePoints, {}}));
}

TEST(Distance, AgreesWithThePredicate) {
  const std::vector<double> positions{0, 0, 0, 3, 4, 12};
  EXPECT_EQ(distance(positions, 0, 1), 13);
  EXPECT_EQ(distance(positions, 1, 1), 0);
}

TEST(Distance, RefusesAVertexOutOfRange) {
  const auto out_of_range = ErrorCode::VertexOutOfRange;
  expect_refused(out_of_range, "vertex 3, but the mesh has 3", [] { return distance(kThreePoints, 3, 0); });
  expect_refused(out_of_range, "vertex 9, but the mesh has 3", [] { return distance(kThreePoints, 0, 9); });
}

TEST(ValidateOnThreads, NamesTheFirstFaultWhateverTheThreadThatFindsOneFirst) {
  std::vector<float> xyz(3 * 100000, 0.5F);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  xyz[3 * 99999] = xyz[3 * 60000 + 1] = xyz[3 * 60000 + 2] = nan;
  std::vector<std::uint32_t> corners(3 * 100000, 1);
  corners[3 * 99999] = corners[3 * 40000 + 2] = corners[3 * 40000 + 1] = 100000;
  const Progress silent;
  for (int i = 0; i < 50; ++i) {
    TaskContext task(4, silent, 0);
    expect_refused(ErrorCode::InvalidMesh, "vertex 60000: y is nan", [&] { validate(PositionsView(xyz), task); });
    const std::vector<float> valid(xyz.size(), 0.5F);
    expect_refused(ErrorCode::InvalidMesh, "face 40000: corner 1 is vertex 100000",
                   [&] { validate(MeshView{valid, FacesView::triangles(corners)}, task); });
  }
}

}  // namespace
}  // namespace meshhood::test
