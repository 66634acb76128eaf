// SPDX-License-Identifier: MIT
// Path distances and rings, against the relaxation of all edges until nothing changes.
#include "meshhood/edge_search.h"

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

#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/oracle.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// The least length of a path to each vertex, by the algorithm of Bellman and Ford. `length(v, w)` is that of an edge.
template <class Length>
std::vector<double> path_distances(const Oracle& graph, std::uint32_t v, const std::vector<std::uint8_t>& walls,
                                   Length&& length) {
  std::vector<double> least(graph.size(), kInfinity);
  if (walls[v] != 0) return least;
  least[v] = 0;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::uint32_t a = 0; a < graph.size(); ++a) {
      if (least[a] == kInfinity) continue;
      for (const std::uint32_t b : graph.neighbors(a)) {
        const double through = least[a] + length(a, b);
        if (walls[b] != 0 || !(through < least[b])) continue;
        least[b] = through;
        has_changed = true;
      }
    }
  }
  return least;
}

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
      const Oracle graph(mesh);
      EdgeSearcher searcher(index);
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(cases, 2) && !HasFailure(); ++i, ++count) {
        const auto v = static_cast<VertexId>(random.below(mesh.size()));
        const bool has_masks = random.below(2) == 0;
        const auto walls = draw_mask(random, mesh.size(), has_masks ? 6 : 0);
        const auto ignored = draw_mask(random, mesh.size(), has_masks ? 3 : 0);
        const Index searched = masked(index, has_masks ? Masks{.walls = walls, .ignored = ignored} : Masks{});
        searcher.rebind(searched);
        f(graph, searcher, v, random, walls, ignored);
      }
    }
    std::printf("%s: %zu cases\n", std::string(GetParam().name).c_str(), count);
  }
};

TEST_P(AlongEdges, PathDistancesAreTheLeast) {
  for_each_case(8, [](const Oracle& graph, EdgeSearcher& searcher, VertexId v, Random& random, const auto& walls,
                      const auto& ignored) {
    const auto length = [&](std::size_t a, std::size_t b) { return graph.distance(a, b); };
    const std::vector<double> least = path_distances(graph, v, walls, length);
    const double tie = least[random.below(least.size())];
    std::vector<double> radii = around(tie);
    radii.insert(radii.end(), {0, kInfinity});
    for (const double radius : radii) {
      std::vector<VertexId> expected;
      for (VertexId w = 0; w < least.size(); ++w) {
        if (least[w] <= radius && least[w] < kInfinity && ignored[w] == 0) expected.push_back(w);
      }
      std::vector<VertexId> ids;
      std::vector<double> distances;
      searcher.neighborhood(v, radius, ids, distances);
      ASSERT_EQ(distances.size(), ids.size());
      ASSERT_TRUE(std::is_sorted(distances.begin(), distances.end()));
      for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(distances[i], least[ids[i]]) << "vertex " << ids[i];
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      searcher.neighborhood(v, radius, ids);
      ASSERT_EQ(sorted(ids), expected) << "radius " << radius;
      ASSERT_EQ(searcher.count(v, radius), expected.size());
      std::vector<VertexId> in_ranges;
      for (const VertexRange& range : searcher.ranges(v, radius)) {
        for (VertexId i = range.begin; i < range.end; ++i) in_ranges.push_back(searcher.permutation()[i]);
      }
      ASSERT_EQ(sorted(in_ranges), expected);
    }
  });
}

TEST_P(AlongEdges, RingsCountTheEdges) {
  for_each_case(8, [](const Oracle& graph, EdgeSearcher& searcher, VertexId v, Random& random, const auto& walls,
                      const auto& ignored) {
    const std::vector<double> hops = path_distances(graph, v, walls, [](std::size_t, std::size_t) { return 1.0; });
    const std::size_t k = random.below(12);
    std::vector<VertexId> ids;
    std::vector<std::size_t> counts;
    searcher.rings(v, k, ids, counts);
    double last = -1;
    for (const double hop : hops) last = hop <= static_cast<double>(k) ? std::max(last, hop) : last;
    ASSERT_EQ(static_cast<double>(counts.size()), last + 1);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      std::vector<VertexId> expected;
      for (VertexId w = 0; w < hops.size(); ++w) {
        if (hops[w] <= static_cast<double>(i) && ignored[w] == 0) expected.push_back(w);
      }
      ASSERT_LE(counts[i], ids.size());
      ASSERT_EQ(sorted({ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(counts[i])}), expected) << "ring " << i;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(All, AlongEdges, testing::ValuesIn(families()), family_name);

TEST(EdgeSearch, MeasuresThePathAroundACorner) {
  const TestMesh mesh = make_grid(4, 4, true);
  const Index index = build(mesh.view());
  EdgeSearcher searcher(index);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  searcher.neighborhood(0, 2, ids, distances);
  EXPECT_THAT(sorted(ids), ElementsAre(0, 1, 2, 4, 5, 8));
  EXPECT_EQ(distances.back(), 2);
}

TEST(EdgeSearch, FindsAllRingsIfKIsLargerThanTheMesh) {
  const TestMesh mesh = make_grid(4, 4, true);
  const Index index = build(mesh.view());
  std::vector<VertexId> ids;
  std::vector<std::size_t> counts;
  EdgeSearcher(index).rings(0, std::numeric_limits<std::size_t>::max(), ids, counts);
  EXPECT_THAT(counts, ElementsAre(1, 3, 6, 10, 13, 15, 16));
}

TEST(EdgeSearch, RefusesInvalidArguments) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Index index = build(mesh.view());
  EdgeSearcher searcher(index);
  std::vector<VertexId> ids{7};
  std::vector<std::size_t> counts{7};
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", [&] { searcher.neighborhood(9, 1, ids); });
  expect_refused(ErrorCode::InvalidRadius, "radius nan",
                 [&] { searcher.neighborhood(0, std::numeric_limits<double>::quiet_NaN(), ids); });
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", [&] { searcher.rings(9, 1, ids, counts); });
  EXPECT_THAT(ids, ElementsAre(7));
  EXPECT_THAT(counts, ElementsAre(7));
}

}  // namespace
}  // namespace meshhood::test
