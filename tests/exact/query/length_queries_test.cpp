// SPDX-License-Identifier: MIT
// The answers by path distance and by number of edges, against the plain searches of the oracle.

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

/// A start, its masks, and the length from it to each vertex.
struct Case {
  Searcher& searcher;
  Metric metric;
  DrawnStart drawn;
  std::vector<double> least;

  [[nodiscard]] Start start() const { return drawn.start(); }
  [[nodiscard]] bool is_ignored(VertexId w) const { return drawn.plain.ignored[w] != 0; }

  /// The vertices of the neighborhood, ascending.
  [[nodiscard]] std::vector<VertexId> within(double radius) const {
    std::vector<VertexId> ids;
    for (VertexId w = 0; w < least.size(); ++w) {
      if (least[w] <= radius && least[w] < kInfinity && !is_ignored(w)) ids.push_back(w);
    }
    return ids;
  }
};

class AlongEdges : public testing::TestWithParam<Family> {
 protected:
  template <class F>
  void for_each_case(std::size_t cases, F&& f) {
    std::size_t count = 0;
    for (const std::size_t vertices : {1U, 2U, 30U, 150U, 500U}) {
      const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(mesh.name);
      const Index index = build(mesh.view());
      const RegionOracle oracle(mesh);
      const Oracle& graph = oracle.graph();
      std::array searchers{Searcher(index, Metric::Path), Searcher(index, Metric::Rings)};
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(2 * cases, 4) && !HasFailure(); ++i, ++count) {
        const Metric metric = i % 2 == 0 ? Metric::Path : Metric::Rings;
        Case one{searchers[i % 2], metric, draw_start(random, mesh), {}};
        if (metric == Metric::Rings) {
          one.drawn.is_vertex = true;
          one.drawn.plain.seeds.resize(1);
          one.drawn.plain.center = position(mesh, one.drawn.plain.seeds[0]);
        }
        one.least = oracle.path_lengths(one.drawn.plain, kInfinity, [&](std::size_t a, std::size_t b) {
          return metric == Metric::Path ? graph.distance(a, b) : 1;
        });
        const Index searched = one.drawn.on(index);
        one.searcher.rebind(searched);
        f(one, random);
      }
    }
    std::printf("%s: %zu cases\n", std::string(GetParam().name).c_str(), count);
  }
};

/// Zero, infinity, and the length to a vertex with its neighboring numbers.
std::vector<double> radii_of(const Case& one, Random& random) {
  std::vector<double> radii = around(one.least[random.below(one.least.size())]);
  radii.insert(radii.end(), {0, kInfinity});
  std::ranges::sort(radii);
  std::erase_if(radii, [](double radius) { return radius < 0; });
  radii.erase(std::ranges::unique(radii).begin(), radii.end());
  return radii;
}

TEST_P(AlongEdges, LengthsAreTheLeast) {
  for_each_case(8, [](Case& one, Random& random) {
    for (const double radius : radii_of(one, random)) {
      const std::vector<VertexId> expected = one.within(radius);
      std::vector<VertexId> ids;
      std::vector<double> distances;
      one.searcher.neighborhood(one.start(), radius, ids, distances);
      ASSERT_EQ(distances.size(), ids.size());
      if (one.metric == Metric::Path) {
        ASSERT_TRUE(std::ranges::is_sorted(distances));
      }
      for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(distances[i], one.least[ids[i]]) << "vertex " << ids[i];
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      std::vector<VertexId> alone;
      one.searcher.neighborhood(one.start(), radius, alone);
      ASSERT_EQ(alone, ids) << "radius " << radius;
      ASSERT_EQ(one.searcher.count(one.start(), radius), expected.size());
      ASSERT_TRUE(!one.drawn.is_vertex || one.searcher.has_seed(one.start(), radius));
      std::vector<VertexId> in_ranges;
      for (const VertexRange& range : one.searcher.ranges(one.start(), radius)) {
        for (VertexId i = range.begin; i < range.end; ++i) in_ranges.push_back(one.searcher.permutation()[i]);
      }
      if (one.metric == Metric::Rings) {
        ASSERT_EQ(in_ranges, ids) << "in index order";
      }
      ASSERT_EQ(sorted(in_ranges), expected);
      const Dab dab{one.start(), radius};
      one.searcher.stroke({&dab, 1}, ids);
      ASSERT_EQ(ids, in_ranges);
    }
  });
}

TEST_P(AlongEdges, NestedRadiiAreThoseOfOneRadiusEach) {
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

TEST_P(AlongEdges, ConnectingRadiiAreLengths) {
  for_each_case(8, [](Case& one, Random& random) {
    const auto w = static_cast<VertexId>(random.below(one.least.size()));
    const double length = one.is_ignored(w) ? kInfinity : one.least[w];
    ASSERT_EQ(one.searcher.connecting_radius(one.start(), w), length);
    ASSERT_EQ(one.searcher.contains(one.start(), w, length), length < kInfinity);
    ASSERT_EQ(one.searcher.contains(one.start(), w, kInfinity), length < kInfinity);
    if (length > 0) {
      ASSERT_FALSE(one.searcher.contains(one.start(), w, std::nextafter(length, 0)));
    }
    std::vector<VertexId> all;
    std::vector<double> lengths;
    one.searcher.nearest_connected(one.start(), one.least.size() + 1, all, lengths);
    ASSERT_EQ(sorted(all), one.within(kInfinity));
    ASSERT_TRUE(std::ranges::is_sorted(lengths));
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(lengths[i], one.least[all[i]]);
    const std::size_t k = random.below(all.size() + 1);
    std::vector<VertexId> some;
    one.searcher.nearest_connected(one.start(), k, some, lengths);
    ASSERT_EQ(some, std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k)));
  });
}

INSTANTIATE_TEST_SUITE_P(All, AlongEdges, testing::ValuesIn(families()), family_name);

TEST(EdgeSearch, RefusesInvalidArguments) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Index index = build(mesh.view());
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
