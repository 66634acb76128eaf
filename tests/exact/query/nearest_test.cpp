// SPDX-License-Identifier: MIT
// The vertex nearest to a point, against a scan of all vertices.
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"
#include "meshhood/start.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

MESHHOOD_SUITE_OF_FAMILIES(NearestIn);

TEST_P(NearestIn, IsTheFirstOfAScan) {
  std::size_t points = 0;
  for (const std::size_t vertices : {1U, 2U, 40U, 300U, 2000U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    if (mesh.size() == 0) continue;
    SCOPED_TRACE(mesh.name);
    const Index index = build(mesh.view());
    const RegionOracle oracle(mesh);
    Random random(vertices);
    std::vector<SpacePoint> asked;
    std::vector<NearestVertex> answers;
    for (std::size_t i = 0; i < scaled(60, 6); ++i, ++points) {
      PlainStart start = draw_start(random, mesh).plain;
      if (i % 7 == 6) start.center = {-start.center[1], start.center[2], 1e30};
      VertexId expected = 0;
      for (VertexId v = 1; v < mesh.size(); ++v) {
        if (oracle.distance(start, v) < oracle.distance(start, expected)) expected = v;
      }
      const NearestVertex found = nearest(index, start.center);
      ASSERT_EQ(found.vertex, expected);
      ASSERT_EQ(found.distance, oracle.distance(start, expected));
      asked.push_back(start.center);
      answers.push_back(found);
    }
    for (const unsigned threads : {1U, 3U}) ASSERT_EQ(nearest(index, asked, {.threads = threads}), answers);
  }
  std::printf("%s: %zu points\n", std::string(GetParam().name).c_str(), points);
}

TEST(Nearest, OfSeveralIsTheOneWithTheSmallestId) {
  const auto [mesh, index] = indexed(make_grid(9, 9, false));
  EXPECT_EQ(nearest(index, {3.5, 3.5, 0}).vertex, 30U);
  EXPECT_EQ(nearest(index, {4, 4, 100}).vertex, 40U);
}

TEST(Nearest, OfSeveralWhoseSquaredDistancesHaveOneRootIsTheOneWithTheSmallestId) {
  TestMesh mesh;
  mesh.add_vertex(1, 0x1p-26, 0);  // squared distance 1 + 2^-52 from the origin, distance 1
  mesh.add_vertex(1, 0, 0);
  const Index index = build(mesh.finish(true).view());
  const NearestVertex found = nearest(index, {0, 0, 0});
  EXPECT_EQ(found.vertex, 0U);
  EXPECT_EQ(found.distance, 1);
}

TEST(Nearest, RefusesAPointThatIsNotFiniteAndAMeshWithoutVertices) {
  const auto [mesh, index] = indexed(make_grid(3, 3, false));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(ErrorCode::InvalidOption, "point: coordinate 0 is nan", [&] { return nearest(index, {nan, 0, 0}); });
  const std::vector<SpacePoint> points{{0, 0, 0}, {0, 0, nan}};
  expect_refused(ErrorCode::InvalidOption, "points: row 1: coordinate 2 is nan",
                 [&] { return nearest(index, points); });
  EXPECT_TRUE(nearest(index, std::vector<SpacePoint>{}).empty());
  const Index empty = build(TestMesh{}.finish(true).view());
  expect_refused(ErrorCode::VertexOutOfRange, "no vertices", [&] { return nearest(empty, {0, 0, 0}); });
}

TEST(Nearest, IsNoWallButMayBeIgnored) {
  const auto [mesh, index] = indexed(make_grid(3, 3, false));
  std::vector<std::uint8_t> some(9);
  some[0] = some[3] = 1;
  EXPECT_EQ(nearest(masked(index, {.walls = some}), {0, 0, 0}).vertex, 1U);
  EXPECT_EQ(nearest(masked(index, {.ignored = some}), {0, 0, 0}).vertex, 0U);
  const std::vector<std::uint8_t> all(9, 1);
  const Index none = masked(index, {.walls = all});
  expect_refused(ErrorCode::VertexOutOfRange, "all vertices of the mesh are walls",
                 [&] { return nearest(none, {0, 0, 0}); });
}

TEST(StartNearest, HasTheNearestVertexAsItsOnlySeed) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  Searcher searcher(index);
  for (const SpacePoint& p : {SpacePoint{3.2, 4.1, 0.5}, SpacePoint{28, 28, -1}, SpacePoint{-50, 0, 0}}) {
    const std::array seed{nearest(index, p).vertex};
    const Start start = Start::nearest(index, p);
    const Start copy = start;  // NOLINT(performance-unnecessary-copy-initialization): a copy has a seed of its own
    EXPECT_EQ(copy.center(), p);
    EXPECT_THAT(copy.seeds(), testing::ElementsAre(seed[0]));
    EXPECT_EQ(searcher.neighborhood(Start::nearest(index, p), 4), searcher.neighborhood(Start(p, seed), 4));
    EXPECT_EQ(searcher.count(Start::nearest(index, p), 4) == 0, p[0] < 0);
  }
}

TEST(PointOnFace, IsTheWeightedSumOfTheCorners) {
  const auto [mesh, index] = indexed(make_grid(3, 3, false));
  const std::array<VertexId, 3> corners{0, 1, 3};
  const SpacePoint p = point_on_face(index, corners, std::array{0.5, 0.25, 0.25});
  const SpacePoint expected{0.25 * mesh.positions[3] + 0.25 * mesh.positions[9],
                            0.25 * mesh.positions[4] + 0.25 * mesh.positions[10], 0};
  EXPECT_EQ(p, expected);
}

TEST(PointOnFace, RefusesWeightsThatAreNotOneFiniteNumberForEachCorner) {
  const auto [mesh, index] = indexed(make_grid(3, 3, false));
  const std::array<VertexId, 3> corners{0, 1, 99};
  expect_refused(ErrorCode::InvalidOption, "weights: 2 values",
                 [&] { return point_on_face(index, corners, std::array{0.5, 0.5}); });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(ErrorCode::InvalidOption, "weights: value 1 is nan",
                 [&] { return point_on_face(index, corners, std::array{0.5, nan, 0.5}); });
  expect_refused(ErrorCode::VertexOutOfRange, "corner 2: vertex 99",
                 [&] { return point_on_face(index, corners, std::array{0.5, 0.25, 0.25}); });
}

}  // namespace
}  // namespace meshhood::test
