// SPDX-License-Identifier: MIT
// The exact index against the oracle: millions of answers on thousands of small meshes of all families.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

struct Tally {
  std::size_t meshes = 0;
  std::size_t queries = 0;
  std::size_t mismatches = 0;
};

/// Queries one mesh at least `queries` times, with every instruction set in turn.
void compare(const TestMesh& mesh, std::uint64_t seed, std::size_t queries, Tally& tally) {
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  std::vector<Searcher> searchers = searchers_of(index);
  Random random(seed);
  std::vector<VertexId> ids;
  ++tally.meshes;
  for (std::size_t asked = 0; mesh.size() > 0 && asked < queries;) {
    const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
    for (const double radius : draw_radii(random, oracle, v)) {
      searchers[asked++ % searchers.size()].neighborhood(v, radius, ids);
      std::sort(ids.begin(), ids.end());
      ++tally.queries;
      if (ids == oracle.exact(v, radius)) continue;
      ++tally.mismatches;
      ADD_FAILURE() << mesh.name << ": vertex " << v << ", radius " << radius;
    }
  }
}

class SearchDifferential : public testing::TestWithParam<Family> {};

TEST_P(SearchDifferential, AnswersAreThoseOfTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < scaled(152, 2) && tally.mismatches < 10; ++seed) {
    const std::size_t size = std::min<std::size_t>(draw_size(seed), 1500);
    compare(make_mesh(GetParam(), seed, size), seed, 1000, tally);
  }
  std::printf("%s: %zu queries, %zu meshes, %zu mismatches\n", std::string(GetParam().name).c_str(), tally.queries,
              tally.meshes, tally.mismatches);
  EXPECT_EQ(tally.mismatches, 0U);
  EXPECT_GT(tally.meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchDifferential, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
