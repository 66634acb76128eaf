// SPDX-License-Identifier: MIT
// Regions, nested radii, membership, connecting radii and strokes, against the plain searches of the oracle on small
// meshes of every kind.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"

#include "exact/query/single_queries.h"
#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Searcher region_searcher(const Index& index, Isa isa) {
  Searcher searcher(index);
  SearcherAccess::set_isa(searcher, isa);
  return searcher;
}

class Regions : public testing::TestWithParam<Family> {
 protected:
  /// Calls `f(mesh, oracle, index, isa, random)` for meshes of many sizes, with many starts each.
  template <class F>
  void for_each_case(std::size_t cases, F&& f) {
    std::size_t count = 0;
    for (const std::size_t vertices : {1U, 2U, 7U, 33U, 150U, 600U}) {
      for (std::uint64_t seed = 0; seed < 2; ++seed) {
        const TestMesh mesh = make_mesh(GetParam(), seed, vertices);
        if (mesh.size() == 0) continue;
        SCOPED_TRACE(mesh.name);
        const Index index = build(mesh.view());
        const RegionOracle oracle(mesh);
        const std::vector<Isa> isas = available_isas();
        Random random(seed + vertices);
        for (std::size_t i = 0; i < scaled(cases, 3); ++i, ++count) {
          f(mesh, oracle, index, isas[count % isas.size()], random);
          if (HasFailure()) return;
        }
      }
    }
    std::printf("%s: %zu cases\n", std::string(GetParam().name).c_str(), count);
  }
};

/// Zero, infinity, and distances of vertices with their neighboring numbers.
std::vector<double> radii_of(const RegionOracle& oracle, const PlainStart& start, Random& random) {
  std::vector<double> radii{0, kInfinity};
  for (int i = 0; i < 3; ++i) {
    for (const double radius : around(oracle.distance(start, random.below(oracle.graph().size())))) {
      radii.push_back(radius);
    }
  }
  return radii;
}

TEST_P(Regions, AreThoseOfAPlainSearch) {
  for_each_case(12, [](const TestMesh& mesh, const RegionOracle& oracle, const Index& index, Isa isa, Random& random) {
    const DrawnStart drawn = draw_start(random, mesh);
    Searcher searcher = region_searcher(drawn.on(index), isa);
    for (const double radius : radii_of(oracle, drawn.plain, random)) {
      const std::vector<VertexId> expected = oracle.region(drawn.plain, radius);
      std::vector<VertexId> ids;
      std::vector<double> distances;
      searcher.neighborhood(drawn.start(), radius, ids, distances);
      ASSERT_EQ(distances.size(), ids.size());
      for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(distances[i], oracle.distance(drawn.plain, ids[i]));
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      searcher.neighborhood(drawn.start(), radius, ids);
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      ASSERT_EQ(searcher.count(drawn.start(), radius), expected.size());
    }
  });
}

TEST_P(Regions, OfNestedRadiiAreThoseOfOneRadiusEach) {
  for_each_case(8, [](const TestMesh& mesh, const RegionOracle& oracle, const Index& index, Isa isa, Random& random) {
    const DrawnStart drawn = draw_start(random, mesh);
    Searcher searcher = region_searcher(drawn.on(index), isa);
    std::vector<double> radii = radii_of(oracle, drawn.plain, random);
    std::sort(radii.begin(), radii.end());
    radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
    std::vector<VertexId> ids;
    std::vector<std::size_t> counts;
    searcher.nested(drawn.start(), radii, ids, counts);
    ASSERT_EQ(counts.size(), radii.size());
    ASSERT_EQ(counts.back(), ids.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      ASSERT_LE(counts[i], ids.size());
      const auto end = ids.begin() + static_cast<std::ptrdiff_t>(counts[i]);
      ASSERT_EQ(sorted({ids.begin(), end}), oracle.region(drawn.plain, radii[i])) << "radius " << radii[i];
    }
  });
}

TEST_P(Regions, ContainAVertexFromItsConnectingRadiusOn) {
  for_each_case(8, [](const TestMesh& mesh, const RegionOracle& oracle, const Index& index, Isa isa, Random& random) {
    const DrawnStart drawn = draw_start(random, mesh);
    Searcher searcher = region_searcher(drawn.on(index), isa);
    const std::vector<double> expected = oracle.connecting_radii(drawn.plain);
    for (int i = 0; i < 6; ++i) {
      const auto w = static_cast<VertexId>(random.below(mesh.size()));
      const double radius = searcher.connecting_radius(drawn.start(), w);
      ASSERT_EQ(radius, expected[w]) << "vertex " << w;
      ASSERT_EQ(searcher.contains(drawn.start(), w, radius), radius < kInfinity) << "vertex " << w;
      if (radius == 0) continue;
      ASSERT_FALSE(searcher.contains(drawn.start(), w, std::nextafter(radius, 0))) << "vertex " << w;
    }
  });
}

TEST_P(Regions, GrowByTheNearestConnectedVertices) {
  for_each_case(6, [](const TestMesh& mesh, const RegionOracle& oracle, const Index& index, Isa isa, Random& random) {
    const DrawnStart drawn = draw_start(random, mesh);
    Searcher searcher = region_searcher(drawn.on(index), isa);
    const std::vector<double> radii = oracle.connecting_radii(drawn.plain);
    std::vector<std::uint32_t> expected = oracle.in_order(drawn.plain, radii);
    const std::size_t k = random.below(4) == 0 ? mesh.size() + 1 : random.below(mesh.size() + 1);
    expected.resize(std::min(k, expected.size()));
    std::vector<VertexId> ids;
    std::vector<double> found;
    searcher.nearest_connected(drawn.start(), k, ids, found);
    ASSERT_EQ(ids, expected);
    ASSERT_EQ(found.size(), ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(found[i], radii[ids[i]]);
  });
}

TEST_P(Regions, OfAStrokeAreTheirUnion) {
  for_each_case(6, [](const TestMesh& mesh, const RegionOracle& oracle, const Index& index, Isa isa, Random& random) {
    std::vector<DrawnStart> drawn(random.below(5));
    std::vector<Dab> dabs;
    std::vector<VertexId> expected;
    for (DrawnStart& one : drawn) {
      one = draw_start(random, mesh);
      one.plain.walls = drawn.front().plain.walls;
      one.plain.ignored = drawn.front().plain.ignored;
      const double radius = oracle.distance(one.plain, random.below(mesh.size()));
      dabs.push_back({one.start(), radius});
      const auto part = oracle.region(one.plain, radius);
      expected.insert(expected.end(), part.begin(), part.end());
    }
    expected = sorted(expected);
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    std::vector<VertexId> ids;
    const Masks masks =
        drawn.empty() ? Masks{} : Masks{.walls = drawn.front().plain.walls, .ignored = drawn.front().plain.ignored};
    region_searcher(masked(index, masks), isa).stroke(dabs, ids);
    ASSERT_EQ(sorted(ids), expected);
  });
}

INSTANTIATE_TEST_SUITE_P(All, Regions, testing::ValuesIn(families()), family_name);

TEST(Region, SaysWhetherASeedLiesInTheBall) {
  const TestMesh mesh = make_grid(5, 5, false);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  const SpacePoint above{2, 2, 3};
  const std::array<VertexId, 2> seeds{0, 12};  // 12 at exactly 3, and 0 farther
  const Start start(above, seeds);
  EXPECT_TRUE(searcher.has_seed(start, 3));
  EXPECT_FALSE(searcher.has_seed(start, 2.9));
  EXPECT_FALSE(searcher.has_seed({above, {}}, 100)) << "no seeds";
  std::vector<VertexId> ids;
  std::vector<std::size_t> counts;
  searcher.nested(start, std::array{1.0, 3.0}, ids, counts);
  EXPECT_THAT(counts, testing::ElementsAre(0, 1));

  // A vertex always lies in its ball. A wall does, too, although nothing is found.
  std::vector<std::uint8_t> walls(25);
  walls[12] = 1;
  Searcher with_wall = region_searcher(masked(index, {.walls = walls}), best_isa());
  EXPECT_TRUE(with_wall.has_seed(12, 0));
  EXPECT_TRUE(with_wall.has_seed(start, 3));
  EXPECT_EQ(with_wall.count(12, 0) + with_wall.count(start, 3), 0U);

  searcher.stroke(std::array{Dab{start, 2.9}, Dab{0, 0}}, ids);
  EXPECT_THAT(ids, testing::ElementsAre(0));
}

TEST(Region, WithoutSeedsIsEmpty) {
  const TestMesh mesh = make_grid(5, 5, false);
  const Index index = build(mesh.view());
  for (const Metric metric : {Metric::Straight, Metric::Path}) {
    Searcher searcher(index, metric);
    EXPECT_EQ(searcher.count({{1, 1, 0}, {}}, 10), 0U);
    EXPECT_EQ(searcher.connecting_radius({{1, 1, 0}, {}}, 0), kInfinity);
  }
}

TEST(Region, EndsAtWallsAndPassesIgnoredVertices) {
  const TestMesh mesh = make_grid(9, 3, true);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  std::vector<std::uint8_t> row(mesh.size());
  for (VertexId v = 12; v < 15; ++v) row[v] = 1;  // the fifth of nine rows of three
  const std::vector<bool> bits(row.begin(), row.end());
  EXPECT_EQ(region_searcher(masked(index, {.walls = row}), best_isa()).count(VertexId{0}, kInfinity), 12U);
  EXPECT_EQ(region_searcher(masked(index, {.walls = bits}), best_isa()).count(VertexId{0}, kInfinity), 12U);
  EXPECT_EQ(region_searcher(masked(index, {.ignored = bits}), best_isa()).count(VertexId{0}, kInfinity), 24U);
  EXPECT_EQ(region_searcher(masked(index, {.ignored = row}), best_isa()).count(VertexId{0}, kInfinity), 24U);
  EXPECT_EQ(region_searcher(masked(index, {.walls = row}), best_isa()).count(VertexId{12}, kInfinity), 0U)
      << "a wall is no seed";
  EXPECT_EQ(region_searcher(masked(index, {.walls = row}), best_isa()).connecting_radius(VertexId{0}, 26), kInfinity);
}

TEST(Region, RefusesInvalidArguments) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  std::vector<VertexId> ids{1, 2};
  std::vector<std::size_t> counts{5};
  const std::vector<VertexId> seeds{0, 9};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto search = [&](const Start& start, double radius) {
    return [&, start, radius] { searcher.neighborhood(start, radius, ids); };
  };
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", search(VertexId{9}, 1));
  expect_refused(ErrorCode::VertexOutOfRange, "seed 1: vertex 9", search({{0, 0, 0}, seeds}, 1));
  expect_refused(ErrorCode::InvalidOption, "coordinate 1 is nan", search({{0, nan, 0}, {}}, 1));
  expect_refused(ErrorCode::InvalidOption, "coordinate 2 is inf", search({{0, 0, kInfinity}, {}}, 1));
  expect_refused(ErrorCode::InvalidRadius, "radius -1", search(VertexId{0}, -1));
  expect_refused(ErrorCode::InvalidRadius, "radii: value 1",
                 [&] { searcher.nested(VertexId{0}, std::array{1.0, 1.0}, ids, counts); });
  expect_refused(ErrorCode::VertexOutOfRange, "dab 1: vertex 9",
                 [&] { searcher.stroke(std::array{Dab{VertexId{0}, 1}, Dab{VertexId{9}, 1}}, ids); });
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 77",
                 [&] { static_cast<void>(searcher.contains(VertexId{0}, 77, 1)); });
  EXPECT_THAT(ids, ElementsAre(1, 2));
  EXPECT_THAT(counts, ElementsAre(5));
}

}  // namespace
}  // namespace meshhood::test
