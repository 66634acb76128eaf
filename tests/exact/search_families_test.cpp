// SPDX-License-Identifier: MIT
// Exact answers on small meshes of every kind, at all radii at which errors are likely.
#include <cstdio>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// Zero, everything, and the distances of some vertices with their neighboring numbers.
std::vector<double> radii_at(VertexId v, const MeshView& mesh, Random& random) {
  std::vector<double> radii{0, std::numeric_limits<double>::denorm_min(), kInfinity};
  for (int i = 0; i < 5; ++i) {
    const double tie = distance(mesh.positions, v, static_cast<VertexId>(random.below(mesh.positions.size())));
    for (const double radius : around(tie)) radii.push_back(radius);
    radii.push_back(tie * random.uniform(0, 2));
  }
  return radii;
}

class Families : public testing::TestWithParam<Family> {};

TEST_P(Families, AnswersAreThoseOfTheReference) {
  std::size_t meshes = 0;
  std::size_t queries = 0;
  for (const std::size_t vertices : {1U, 2U, 3U, 7U, 33U, 100U, 300U, 1000U, 3000U}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const TestMesh mesh = make_mesh(GetParam(), seed, vertices);
      SCOPED_TRACE(mesh.name);
      ExactAnswer exact(mesh.view());
      EXPECT_THAT(exact.index().check(mesh.view()), testing::IsEmpty());
      Random random(seed);
      for (std::size_t i = 0; i < scaled(24, 4) && mesh.size() > 0; ++i) {
        const auto v = static_cast<VertexId>(random.below(mesh.size()));
        for (const double radius : radii_at(v, mesh.view(), random)) exact.query(v, radius);
      }
      ASSERT_EQ(exact.mismatches(), 0U);
      queries += exact.queries();
      ++meshes;
    }
  }
  std::printf("%s: %zu meshes, %zu queries, 0 mismatches\n", std::string(GetParam().name).c_str(), meshes, queries);
}

TEST_P(Families, EveryVertexOfSmallMeshesAtFiveRadii) {
  std::size_t queries = 0;
  for (const std::size_t vertices : {33U, 120U, 300U}) {
    const TestMesh mesh = make_mesh(GetParam(), 0, vertices);
    SCOPED_TRACE(mesh.name);
    ExactAnswer exact(mesh.view());
    const double unit = mean_edge_length(exact.graph());
    for (VertexId v = 0; v < mesh.size(); ++v) {
      for (const double edges : {0.5, 1.0, 2.0, 5.0, 20.0}) exact.query_ids(v, edges * unit);
    }
    ASSERT_EQ(exact.mismatches(), 0U);
    queries += exact.queries();
  }
  std::printf("%zu queries\n", queries);
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
