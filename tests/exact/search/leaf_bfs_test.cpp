// SPDX-License-Identifier: MIT
// The breadth-first search over leaves against one over vertices.
#include "exact/search/leaf_bfs.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

/// The answer of a search that was used before, perhaps; checks that it is in index order.
Ids found(LeafBfs& bfs, const SearchCase& c) {
  VertexSet answer(c.index);
  bfs.run(c.query, answer);
  Ids ids;
  std::size_t next = 0;
  answer.for_each([&](std::size_t v) {
    EXPECT_GE(v, next) << "not in index order";
    next = v + 1;
    ids.push_back(c.index.id(v));
  });
  return sorted(ids);
}

class LeafBfsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(LeafBfsOnFamilies, FindsTheNeighborhoodInIndexOrder) {
  std::size_t queries = 0;
  std::size_t unfinished = 0;
  for (std::uint64_t seed = 0; seed < scaled(40, 4); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, seed == 0 ? 1500 : std::min<std::size_t>(draw_size(seed), 400));
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index built = build(mesh.view());
    const IndexView& index = IndexAccess::view(built);
    Random random(seed);
    for (const Isa isa : available_isas()) {
      LeafBfs bfs(index, kernels(isa));
      for (int i = 0; i < 3; ++i) {
        const auto v = static_cast<VertexId>(random.below(mesh.size()));
        for (const double radius : draw_radii(random, oracle, v)) {
          const Query query(index, v, RadiusBounds(index.frame, radius));
          const SearchCase c{mesh, oracle, index, query, kernels(isa)};
          const Ids expected = c.neighborhood();
          ASSERT_EQ(found(bfs, c), expected) << mesh.name << ": vertex " << v << ", radius " << radius;
          const std::size_t visits = random.below(12);
          VertexSet answer(index);
          if (bfs.run_within(visits, query, answer)) {
            ASSERT_EQ(answer.count(), expected.size()) << mesh.name << ": vertex " << v << ", " << visits << " visits";
          } else {
            ASSERT_EQ(answer.count(), 0U);
            ++unfinished;
          }
          ++queries;
        }
      }
    }
  }
  std::printf("%zu queries, %zu with too few visits\n", queries, unfinished);
}

INSTANTIATE_TEST_SUITE_P(Families, LeafBfsOnFamilies, testing::ValuesIn(families()), family_name);

// Single vertices between the vertices of a sheet share its leaves: such a leaf is not taken as a whole, although the
// ball holds all of it.
TEST(LeafBfs, LeavesOutOtherComponentsInALeafInsideTheBall) {
  TestMesh mesh;
  Random random(3);
  for (int i = 0; i < 400; ++i) mesh.add_vertex(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
  for (std::uint32_t v = 2; v < 400; v += 2) mesh.add_face({v - 2, v});
  mesh.finish(true);
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  std::size_t disconnected = 0;
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    disconnected += static_cast<std::size_t>(index.leaves[leaf].size != 0 && !index.leaves[leaf].connected);
  }
  ASSERT_GT(disconnected, 0U);
  LeafBfs bfs(index, kernels(best_isa()));
  for (VertexId v = 0; v < mesh.size(); ++v) {
    const Query query(index, v, RadiusBounds(index.frame, kInfinity));
    const SearchCase c{mesh, oracle, index, query, kernels(best_isa())};
    ASSERT_EQ(found(bfs, c), c.neighborhood()) << "vertex " << v;
  }
}

}  // namespace
}  // namespace meshhood::test
