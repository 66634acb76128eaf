// SPDX-License-Identifier: MIT
// The answers to single queries by each metric: regions, nested radii, membership, connecting radii and strokes,
// against the plain searches of the oracle on small meshes of every kind.

#include "exact/query/single_queries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"

#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

constexpr std::array kMetrics{Metric::Straight, Metric::Path, Metric::Rings, Metric::Space};

/// The distances of the vertices that are neither walls nor ignored; infinite for others, and from a wall.
std::vector<double> radii_in_space(const RegionOracle& oracle, const DrawnStart& drawn) {
  const PlainStart& start = drawn.plain;
  std::vector<double> radii(oracle.graph().size(), kInfinity);
  if (drawn.is_vertex && start.walls[start.seeds[0]] != 0) return radii;
  for (std::size_t v = 0; v < radii.size(); ++v) {
    if (start.walls[v] == 0 && start.ignored[v] == 0) radii[v] = oracle.distance(start, v);
  }
  return radii;
}

/// The least radius whose neighborhood has each vertex, infinite for ignored ones.
std::vector<double> least_radii(const RegionOracle& oracle, Metric metric, const DrawnStart& drawn) {
  if (metric == Metric::Straight) return oracle.connecting_radii(drawn.plain);
  if (metric == Metric::Space) return radii_in_space(oracle, drawn);
  const Oracle& graph = oracle.graph();
  std::vector<double> radii = oracle.path_lengths(drawn.plain, kInfinity, [&](std::size_t a, std::size_t b) {
    return metric == Metric::Path ? graph.distance(a, b) : 1;
  });
  for (std::size_t v = 0; v < radii.size(); ++v) {
    if (drawn.plain.ignored[v] != 0) radii[v] = kInfinity;
  }
  return radii;
}

/// A start, its masks, and the least radius of each vertex.
struct Case {
  const TestMesh& mesh;
  const RegionOracle& oracle;
  Searcher& searcher;
  Metric metric;
  DrawnStart drawn;
  std::vector<double> least;

  [[nodiscard]] Start start() const { return drawn.start(); }

  /// What a neighborhood gives as the distance of a vertex.
  [[nodiscard]] double distance(VertexId w) const {
    const bool is_straight = metric == Metric::Straight || metric == Metric::Space;
    return is_straight ? oracle.distance(drawn.plain, w) : least[w];
  }

  /// The vertices of the neighborhood, ascending.
  [[nodiscard]] std::vector<VertexId> within(double radius) const {
    std::vector<VertexId> ids;
    for (VertexId w = 0; w < least.size(); ++w) {
      if (least[w] <= radius && least[w] < kInfinity) ids.push_back(w);
    }
    return ids;
  }
};

/// A start for a metric: of the number of edges, a vertex.
DrawnStart draw_start_for(Metric metric, Random& random, const TestMesh& mesh) {
  DrawnStart drawn = draw_start(random, mesh);
  if (metric == Metric::Rings) {
    drawn.is_vertex = true;
    drawn.plain.seeds.resize(1);
    drawn.plain.center = position(mesh, drawn.plain.seeds[0]);
  }
  return drawn;
}

class SingleQueries : public testing::TestWithParam<Family> {
 protected:
  /// Calls `f(case, random)` for meshes of many sizes, with many starts each.
  template <class F>
  void for_each_case(std::size_t cases, F&& f) {
    const std::vector<Isa> isas = available_isas();
    std::size_t count = 0;
    for (const std::size_t vertices : {1U, 2U, 7U, 33U, 150U, 600U}) {
      const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(mesh.name);
      const Index index = build(mesh.view());
      const RegionOracle oracle(mesh);
      std::vector<Searcher> searchers;
      for (const Metric metric : kMetrics) searchers.emplace_back(index, metric);
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(4 * cases, 8) && !HasFailure(); ++i, ++count) {
        const Metric metric = kMetrics[i % 4];
        Case one{mesh, oracle, searchers[i % 4], metric, draw_start_for(metric, random, mesh), {}};
        one.least = least_radii(oracle, metric, one.drawn);
        const Index searched = one.drawn.on(index);
        one.searcher.rebind(searched);
        SearcherAccess::set_isa(one.searcher, isas[i / 4 % isas.size()]);
        f(one, random);
      }
    }
    std::printf("%s: %zu cases\n", std::string(GetParam().name).c_str(), count);
  }
};

/// Zero, infinity, and the least radius and the distance of a vertex with their neighboring numbers.
std::vector<double> radii_of(const Case& one, Random& random) {
  std::vector<double> radii{0, kInfinity};
  const auto w = static_cast<VertexId>(random.below(one.least.size()));
  for (const double some : {one.least[w], one.distance(w)}) {
    for (const double radius : around(some)) radii.push_back(radius);
  }
  std::ranges::sort(radii);
  std::erase_if(radii, [](double radius) { return radius < 0; });
  radii.erase(std::ranges::unique(radii).begin(), radii.end());
  return radii;
}

TEST_P(SingleQueries, HaveTheVerticesOfTheOracle) {
  for_each_case(12, [](Case& one, Random& random) {
    for (const double radius : radii_of(one, random)) {
      const std::vector<VertexId> expected = one.within(radius);
      std::vector<VertexId> ids;
      std::vector<double> distances;
      one.searcher.neighborhood(one.start(), radius, ids, distances);
      ASSERT_EQ(distances.size(), ids.size());
      if (one.metric == Metric::Path) {
        ASSERT_TRUE(std::ranges::is_sorted(distances));
      }
      for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(distances[i], one.distance(ids[i])) << "vertex " << ids[i];
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      std::vector<VertexId> alone;
      one.searcher.neighborhood(one.start(), radius, alone);
      ASSERT_EQ(alone, ids) << "radius " << radius;
      ASSERT_EQ(one.searcher.count(one.start(), radius), expected.size());
      if (one.drawn.is_vertex || one.metric == Metric::Space) {
        ASSERT_TRUE(one.searcher.has_seed(one.start(), radius));
      }
      std::vector<VertexId> in_ranges;
      for (const VertexRange& range : one.searcher.ranges(one.start(), radius)) {
        for (VertexId i = range.begin; i < range.end; ++i) in_ranges.push_back(one.searcher.permutation()[i]);
      }
      if (one.metric != Metric::Path) {
        ASSERT_EQ(in_ranges, ids) << "in index order";
      }
      ASSERT_EQ(sorted(in_ranges), expected);
      const Dab dab{one.start(), radius};
      one.searcher.stroke({&dab, 1}, ids);
      ASSERT_EQ(ids, in_ranges);
    }
  });
}

TEST_P(SingleQueries, OfNestedRadiiAreThoseOfOneRadiusEach) {
  for_each_case(8, [](Case& one, Random& random) {
    const std::vector<double> radii = radii_of(one, random);
    std::vector<VertexId> ids;
    std::vector<std::size_t> counts;
    one.searcher.nested(one.start(), radii, ids, counts);
    ASSERT_EQ(counts.size(), radii.size());
    ASSERT_EQ(counts.back(), ids.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      ASSERT_LE(counts[i], ids.size());
      const auto end = ids.begin() + static_cast<std::ptrdiff_t>(counts[i]);
      ASSERT_EQ(sorted({ids.begin(), end}), one.within(radii[i])) << "radius " << radii[i];
    }
  });
}

TEST_P(SingleQueries, ContainAVertexFromItsConnectingRadiusOn) {
  for_each_case(8, [](Case& one, Random& random) {
    const auto w = static_cast<VertexId>(random.below(one.least.size()));
    const double radius = one.least[w];
    ASSERT_EQ(one.searcher.connecting_radius(one.start(), w), radius);
    ASSERT_EQ(one.searcher.contains(one.start(), w, radius), radius < kInfinity);
    ASSERT_EQ(one.searcher.contains(one.start(), w, kInfinity), radius < kInfinity);
    if (radius > 0) {
      ASSERT_FALSE(one.searcher.contains(one.start(), w, std::nextafter(radius, 0)));
    }
    if (one.metric == Metric::Space) return;  // refused: whole/metrics_test.cpp
    std::vector<VertexId> all;
    std::vector<double> radii;
    one.searcher.nearest_connected(one.start(), one.least.size() + 1, all, radii);
    ASSERT_EQ(sorted(all), one.within(kInfinity));
    if (one.metric == Metric::Straight) {
      ASSERT_EQ(all, one.oracle.in_order(one.drawn.plain, one.least));
    }
    ASSERT_TRUE(std::ranges::is_sorted(radii));
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(radii[i], one.least[all[i]]);
    const std::size_t k = 1 + random.below(all.size() + 1);
    std::vector<VertexId> some;
    one.searcher.nearest_connected(one.start(), k, some, radii);
    ASSERT_EQ(some, std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()))));
  });
}

TEST_P(SingleQueries, OfAStrokeAreTheirUnion) {
  for_each_case(6, [](Case& one, Random& random) {
    std::vector<DrawnStart> drawn(random.below(5));
    std::vector<Dab> dabs;
    std::set<VertexId> expected;
    for (DrawnStart& another : drawn) {
      another = draw_start_for(one.metric, random, one.mesh);
      another.plain.walls = one.drawn.plain.walls;
      another.plain.ignored = one.drawn.plain.ignored;
      const std::vector<double> least = least_radii(one.oracle, one.metric, another);
      const double radius = least[random.below(least.size())];
      dabs.push_back({another.start(), radius});
      for (VertexId w = 0; w < least.size(); ++w) {
        if (least[w] <= radius && least[w] < kInfinity) expected.insert(w);
      }
    }
    std::vector<VertexId> ids;
    one.searcher.stroke(dabs, ids);
    ASSERT_THAT(sorted(ids), testing::ElementsAreArray(expected));
  });
}

INSTANTIATE_TEST_SUITE_P(All, SingleQueries, testing::ValuesIn(families()), family_name);

TEST(Region, SaysWhetherASeedLiesInTheBall) {
  const auto [mesh, index] = indexed(make_grid(5, 5, false));
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
  const Index walled = masked(index, {.walls = walls});
  Searcher with_wall(walled);
  EXPECT_TRUE(with_wall.has_seed(12, 0));
  EXPECT_TRUE(with_wall.has_seed(start, 3));
  EXPECT_EQ(with_wall.count(12, 0) + with_wall.count(start, 3), 0U);

  searcher.stroke(std::array{Dab{start, 2.9}, Dab{0, 0}}, ids);
  EXPECT_THAT(ids, testing::ElementsAre(0));
}

TEST(Region, WithoutSeedsIsEmptyButInSpace) {
  const auto [mesh, index] = indexed(make_grid(5, 5, false));
  for (const Metric metric : {Metric::Straight, Metric::Path}) {
    Searcher searcher(index, metric);
    EXPECT_EQ(searcher.count({{1, 1, 0}, {}}, 10), 0U);
    EXPECT_EQ(searcher.connecting_radius({{1, 1, 0}, {}}, 0), kInfinity);
  }
  EXPECT_EQ(Searcher(index, Metric::Space).count({{1, 1, 0}, {}}, 10), 25U);
  const Index empty = build(TestMesh{}.view());
  EXPECT_EQ(Searcher(empty, Metric::Space).count({{0, 0, 0}, {}}, kInfinity), 0U);
}

TEST(Region, EndsAtWallsAndPassesIgnoredVertices) {
  const auto [mesh, index] = indexed(make_grid(9, 3, true));
  std::vector<std::uint8_t> row(mesh.size());
  for (VertexId v = 12; v < 15; ++v) row[v] = 1;  // the fifth of nine rows of three
  const std::vector<bool> bits(row.begin(), row.end());
  const auto count = [&](VertexId v, const Masks& masks) {
    const Index searched = masked(index, masks);
    return Searcher(searched).count(v, kInfinity);
  };
  EXPECT_EQ(count(0, {.walls = row}), 12U);
  EXPECT_EQ(count(0, {.walls = bits}), 12U);
  EXPECT_EQ(count(0, {.ignored = bits}), 24U);
  EXPECT_EQ(count(0, {.ignored = row}), 24U);
  EXPECT_EQ(count(12, {.walls = row}), 0U) << "a wall is no seed";
}

TEST(Region, RefusesInvalidArguments) {
  const auto [mesh, index] = indexed(make_grid(3, 3, true));
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
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 77", [&] { return searcher.contains(VertexId{0}, 77, 1); });
  EXPECT_THAT(ids, ElementsAre(1, 2));
  EXPECT_THAT(counts, ElementsAre(5));
}

TEST(EdgeSearch, RefusesInvalidArguments) {
  const auto [mesh, index] = indexed(make_grid(3, 3, true));
  for (const Metric metric : {Metric::Path, Metric::Rings}) {
    Searcher searcher(index, metric);
    std::vector<VertexId> ids{7};
    std::vector<std::size_t> counts{7};
    expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", [&] { searcher.neighborhood(9, 1, ids); });
    expect_refused(ErrorCode::InvalidRadius, "radius nan",
                   [&] { searcher.neighborhood(0, std::numeric_limits<double>::quiet_NaN(), ids); });
    expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", [&] { searcher.nested(9, std::array{1.0}, ids, counts); });
    if (metric == Metric::Rings) {
      expect_refused(ErrorCode::InvalidOption, "a point has no edges",
                     [&] { searcher.neighborhood({{0, 0, 0}, {}}, 1, ids); });
      expect_refused(ErrorCode::InvalidOption, "dab 1: start: expected a vertex",
                     [&] { searcher.stroke(std::array{Dab{0, 1}, Dab{{{0, 0, 0}, {}}, 1}}, ids); });
    }
    EXPECT_THAT(ids, ElementsAre(7));
    EXPECT_THAT(counts, ElementsAre(7));
  }
}

}  // namespace
}  // namespace meshhood::test
