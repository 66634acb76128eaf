// SPDX-License-Identifier: MIT
// The descent against brute force: nodes inside, intersecting leaves, and candidates for local minima.
#include "exact/search/descent.h"

#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

constexpr SearchLimits kNoLimits{.enabled = false};

class DescentOnFamilies : public testing::TestWithParam<Family> {};

/// The caller's ids of all vertices of `leaves`.
Ids vertices_of(const IndexView& index, std::span<const LeafId> leaves) {
  Ids ids;
  for (const LeafId leaf : leaves) {
    for (std::size_t v = index.leaf_begin[leaf]; v < index.leaf_begin[leaf + 1]; ++v) ids.push_back(index.id(v));
  }
  return ids;
}

bool is_local_minimum(const SearchCase& c, std::uint32_t w) {
  const auto& neighbors = c.oracle.neighbors(w);
  const double distance = c.oracle.distance(c.query.vertex, w);
  return std::none_of(neighbors.begin(), neighbors.end(),
                      [&](std::uint32_t u) { return c.oracle.distance(c.query.vertex, u) < distance; });
}

TEST_P(DescentOnFamilies, RunsAreInTheBallAndIntersectingLeavesHoldTheRest) {
  std::size_t inside_vertices = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 4), 4, [&](const SearchCase& c) {
    Descent descent(c.index, c.kernels);
    VertexSet inside(c.index);
    ASSERT_TRUE(descent.run(c.query, kNoLimits, inside));
    Ids ids;
    inside.for_each([&](std::size_t v) { ids.push_back(c.index.id(v)); });
    for (const std::uint32_t w : ids) ASSERT_TRUE(c.is_in_ball(w)) << c.mesh.name;
    inside_vertices += ids.size();
    Ids covered = vertices_of(c.index, descent.intersecting_leaves());
    covered.insert(covered.end(), ids.begin(), ids.end());
    covered = sorted(covered);
    ASSERT_EQ(std::adjacent_find(covered.begin(), covered.end()), covered.end()) << "a vertex comes twice";
    const Ids ball = c.ball();
    ASSERT_TRUE(std::includes(covered.begin(), covered.end(), ball.begin(), ball.end())) << c.mesh.name;
  });
  std::printf("%zu queries, %zu vertices inside\n", cases, inside_vertices);
}

TEST_P(DescentOnFamilies, EveryLocalMinimumInTheBallIsInACandidateLeaf) {
  std::size_t minima = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 4), 4, [&](const SearchCase& c) {
    Descent descent(c.index, c.kernels);
    VertexSet inside(c.index);
    ASSERT_TRUE(descent.run(c.query, kNoLimits, inside));
    std::vector<LeafId> candidates(descent.candidate_leaves().begin(), descent.candidate_leaves().end());
    std::sort(candidates.begin(), candidates.end());
    ASSERT_EQ(std::adjacent_find(candidates.begin(), candidates.end()), candidates.end()) << "a leaf comes twice";
    for (const std::uint32_t w : c.ball()) {
      if (!is_local_minimum(c, w)) continue;
      ++minima;
      ASSERT_TRUE(std::binary_search(candidates.begin(), candidates.end(), c.leaf_of_id(w)))
          << c.mesh.name << ": vertex " << w << " seen from " << c.query.vertex << ", radius " << c.query.radius;
    }
  });
  std::printf("%zu queries, %zu local minima\n", cases, minima);
  EXPECT_TRUE(cases == 0 || minima > 0);
}

INSTANTIATE_TEST_SUITE_P(Families, DescentOnFamilies, testing::ValuesIn(families()), family_name);

TEST(Descent, CandidatesAreFewOnASmoothSurface) {
  const TestMesh mesh = make_grid(120, 120, false);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Descent descent(index, portable_kernels());
  VertexSet inside(index);
  ASSERT_TRUE(descent.run(Query(index, 60 * 120 + 60, RadiusBounds(index.frame, 40)), SearchLimits{}, inside));
  EXPECT_GT(inside.count(), 3000U);
  EXPECT_LT(descent.candidate_leaves().size(), index.leaf_count() / 10);
}

TEST(Descent, ManySheetsExceedTheLimitOfIntersectingNodes) {
  TestMesh mesh = make_grid(24, 24, false);
  for (int sheet = 1; sheet < 60; ++sheet) {
    TestMesh next = make_grid(24, 24, false);
    for (std::size_t i = 2; i < next.positions.size(); i += 3) next.positions[i] = 0.5 * sheet;
    append(mesh, next);
  }
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Descent descent(index, portable_kernels());
  const Query query(index, 30 * 24 * 24 + 12 * 24 + 12, RadiusBounds(index.frame, 11));
  VertexSet inside(index);
  EXPECT_FALSE(descent.run(query, SearchLimits{}, inside));
  inside.clear();
  EXPECT_TRUE(descent.run(query, kNoLimits, inside));
}

}  // namespace
}  // namespace meshhood::test
