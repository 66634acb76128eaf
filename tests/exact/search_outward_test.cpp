// SPDX-License-Identifier: MIT
// The outward search without its limits: the breadth-first search never answers, so every answer is the part that the
// outward search has reached, without the other components. Compared with the oracle on all families.
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

struct OutwardTally {
  std::size_t meshes = 0;
  std::size_t queries = 0;
  std::size_t outward = 0;
  std::size_t of_crumbs = 0;
  std::size_t mismatches = 0;
};

void compare_outward(const TestMesh& mesh, std::uint64_t seed, std::size_t queries, OutwardTally& tally) {
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  std::vector<Searcher> searchers = searchers_of(index);
  for (Searcher& searcher : searchers) SearcherAccess::state(searcher).limits.enabled = false;
  Random random(seed);
  std::vector<VertexId> ids;
  ++tally.meshes;
  for (const std::size_t end = tally.queries + queries; tally.queries < end;) {
    const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
    for (const double radius : draw_radii(random, oracle, v)) {
      Searcher& searcher = searchers[tally.queries++ % searchers.size()];
      searcher.neighborhood(v, radius, ids);
      const SearcherAccess::State& state = SearcherAccess::state(searcher);
      tally.outward += static_cast<std::size_t>(state.was_outward);
      // Vertices of crumbs are answered within their leaf.
      tally.of_crumbs += static_cast<std::size_t>(!state.index->leaves[leaf_of(state.index->slot[v])].connected);
      std::sort(ids.begin(), ids.end());
      if (ids == oracle.exact(v, radius)) continue;
      ++tally.mismatches;
      ADD_FAILURE() << mesh.name << ": vertex " << v << ", radius " << radius;
    }
  }
}

class SearchOutward : public testing::TestWithParam<Family> {};

TEST_P(SearchOutward, AloneGivesTheAnswersOfTheOracle) {
  OutwardTally tally;
  for (std::uint64_t seed = 0; seed < scaled(25, 2) && tally.mismatches < 10; ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, std::min<std::size_t>(draw_size(seed), 1500));
    if (mesh.size() > 0) compare_outward(mesh, seed, 150, tally);
  }
  std::printf("%s: %zu queries, %zu meshes, %zu mismatches\n", std::string(GetParam().name).c_str(), tally.queries,
              tally.meshes, tally.mismatches);
  EXPECT_EQ(tally.mismatches, 0U);
  EXPECT_EQ(tally.outward + tally.of_crumbs, tally.queries);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchOutward, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
