// SPDX-License-Identifier: MIT
// The exact index against the reference search on random meshes of all families: ids, distances, counts and ranges,
// with each instruction set. whole/differential compares the reference search with the oracle.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class SearchDifferential : public testing::TestWithParam<Family> {};

TEST_P(SearchDifferential, AnswersAreThoseOfTheReference) {
  constexpr std::size_t kQueries = 1000;
  std::size_t meshes = 0;
  std::size_t queries = 0;
  std::size_t mismatches = 0;
  for (std::uint64_t seed = 0; seed < scaled(152, 2) && mismatches < 10; ++seed) {
    const std::size_t size = seed % 8 == 7 ? 1 + seed / 8 % 4 : std::min<std::size_t>(draw_size(seed), 1500);
    const TestMesh mesh = make_mesh(GetParam(), seed, size);
    SCOPED_TRACE(mesh.name);
    const Oracle oracle(mesh);
    ExactAnswer exact(mesh.view());
    EXPECT_THAT(exact.index().check(mesh.view()), testing::IsEmpty());
    Random random(seed);
    while (mesh.size() > 0 && exact.queries() < kQueries) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) exact.query(v, radius);
    }
    ++meshes;
    queries += exact.queries();
    mismatches += exact.mismatches();
  }
  std::printf("%s: %zu queries, %zu meshes, %zu mismatches\n", std::string(GetParam().name).c_str(), queries, meshes,
              mismatches);
  EXPECT_EQ(mismatches, 0U);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchDifferential, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
