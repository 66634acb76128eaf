// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"

namespace meshhood::test {

struct Tally {
  std::size_t meshes = 0;
  std::size_t queries = 0;
  std::size_t mismatches = 0;
};

/// Queries one mesh at least `queries` times, with every instruction set in turn, and compares the ids with the oracle.
///
/// prepare  called with each searcher before its first query
/// inspect  called with the searcher and the vertex after each query
template <class Prepare, class Inspect>
void compare_with_oracle(const TestMesh& mesh, std::uint64_t seed, std::size_t queries, Tally& tally, Prepare&& prepare,
                         Inspect&& inspect) {
  ++tally.meshes;
  if (mesh.size() == 0) return;
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  std::vector<Searcher> searchers = searchers_of(index);
  for (Searcher& searcher : searchers) prepare(searcher);
  Random random(seed);
  std::vector<VertexId> ids;
  for (std::size_t asked = 0; asked < queries;) {
    const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
    for (const double radius : draw_radii(random, oracle, v)) {
      Searcher& searcher = searchers[asked++ % searchers.size()];
      searcher.neighborhood(v, radius, ids);
      inspect(searcher, v);
      ++tally.queries;
      std::sort(ids.begin(), ids.end());
      if (ids == oracle.exact(v, radius)) continue;
      ++tally.mismatches;
      ADD_FAILURE() << mesh.name << ": vertex " << v << ", radius " << radius;
    }
  }
}

/// For `meshes` meshes of a family, and stops after ten mismatches. Prints and checks the tally.
template <class Prepare, class Inspect>
Tally compare_family(const Family& family, std::uint64_t meshes, std::size_t queries, Prepare&& prepare,
                     Inspect&& inspect) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < meshes && tally.mismatches < 10; ++seed) {
    const TestMesh mesh = make_mesh(family, seed, std::min<std::size_t>(draw_size(seed), 1500));
    compare_with_oracle(mesh, seed, queries, tally, prepare, inspect);
  }
  std::printf("%s: %zu queries, %zu meshes, %zu mismatches\n", std::string(family.name).c_str(), tally.queries,
              tally.meshes, tally.mismatches);
  EXPECT_EQ(tally.mismatches, 0U);
  EXPECT_GT(tally.meshes, 0U);
  return tally;
}

}  // namespace meshhood::test
