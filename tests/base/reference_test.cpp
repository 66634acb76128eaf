// SPDX-License-Identifier: MIT
#include "meshhood/reference.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reference_access.h"
#include "support/families.h"
#include "support/oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// A U: its ends are near in space and far along it.
TestMesh horseshoe() {
  TestMesh mesh;
  for (const auto& [x, y] : {std::pair(0, 0), {5, 0}, {10, 0}, {10, 1}, {5, 1}, {0, 1}}) mesh.add_vertex(x, y, 0);
  for (std::uint32_t v = 1; v < 6; ++v) mesh.add_face({v - 1, v});
  return mesh.finish(true);
}

TEST(ExactNeighborhood, ExcludesNearVerticesThatAreNotConnected) {
  const TestMesh mesh = horseshoe();
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 1), ElementsAre(0));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 5), ElementsAre(0, 1));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 9.99), ElementsAre(0, 1));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 10.5), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(ReferenceSearcher, ReturnsTheVertexFirstAndNoDuplicates) {
  const TestMesh mesh = make_grid(20, 20, false);
  ReferenceSearcher searcher(mesh.view());
  std::vector<VertexId> out;
  for (VertexId v = 0; v < mesh.size(); v += 13) {
    searcher.neighborhood(v, 5, out);
    EXPECT_EQ(out.front(), v);
    EXPECT_EQ(std::set<VertexId>(out.begin(), out.end()).size(), out.size());
  }
}

TEST(ReferenceSearcher, AnswersStayTheSameWhenTheQueryNumberWrapsAround) {
  const TestMesh mesh = make_grid(20, 20, false);
  ReferenceSearcher searcher(mesh.view());
  std::vector<VertexId> expected;
  std::vector<VertexId> out;
  for (int i = 0; i < 10; ++i) searcher.neighborhood(210, 5, expected);
  ReferenceAccess::set_query(searcher, std::numeric_limits<std::uint32_t>::max() - 5);
  for (int i = 0; i < 15; ++i) {
    searcher.neighborhood(210, 5, out);
    EXPECT_EQ(out, expected) << "query " << i;
  }
}

TEST(Ball, EqualsTheOracle) {
  std::size_t queries = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 1; seed < scaled(20, 3); ++seed) {
      const TestMesh mesh = make_mesh(family, seed, 20 * seed);
      const Oracle oracle(mesh);
      Random random(seed);
      std::vector<VertexId> out;
      for (int i = 0; mesh.size() > 0 && i < 50; ++i, ++queries) {
        const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
        const double tie = oracle.distance(v, random.below(mesh.size()));
        BallSearcher(mesh.positions_view()).neighborhood(static_cast<VertexId>(v), tie, out);
        ASSERT_TRUE(std::ranges::equal(out, oracle.ball(v, tie))) << mesh.name << ", radius " << tie;
      }
    }
  }
  std::printf("%zu queries, 0 mismatches\n", queries);
}

}  // namespace
}  // namespace meshhood::test
