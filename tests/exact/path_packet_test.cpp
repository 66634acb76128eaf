// SPDX-License-Identifier: MIT
// How often paths from several vertices at once follow a vertex, and where they end. Which they are:
// batch/path_rows_test.cpp.
#include "exact/joint/path_packet.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "support/exact_answer.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

/// A grid, and the queries of all vertices of its first leaf.
struct GridPacket {
  Index index = build(make_grid(40, 40, false).finish(true).view());
  const IndexView& view = IndexAccess::view(index);

  [[nodiscard]] std::vector<PathQuery> queries(double radius) const {
    std::vector<PathQuery> result;
    for (std::uint32_t lane = 0; lane < view.leaves[0].size; ++lane) result.push_back({lane, radius});
    return result;
  }

  [[nodiscard]] PathPacket packet(const PathLimits& limits) const {
    return {view, *IndexAccess::share_graph(index), best_isa(), limits};
  }
};

TEST(PathPacket, TakesEachVertexAFewTimes) {
  const GridPacket grid;
  PathPacket packet = grid.packet({});
  ASSERT_TRUE(packet.run(grid.queries(kInfinity)));
  EXPECT_GE(packet.steps(), grid.view.vertex_count());
  EXPECT_LE(packet.steps(), 2 * grid.view.vertex_count());
}

TEST(PathPacket, EndsAtItsLimits) {
  const GridPacket grid;
  PathPacket of_steps = grid.packet({.steps = 1});
  EXPECT_FALSE(of_steps.run(grid.queries(kInfinity)));
  EXPECT_EQ(of_steps.steps() / grid.view.vertex_count(), 1U);
  PathPacket of_vertices = grid.packet({.vertices = 1599});
  EXPECT_FALSE(of_vertices.run(grid.queries(kInfinity)));
  EXPECT_EQ(of_vertices.steps(), 0U);
  EXPECT_TRUE(of_vertices.run(grid.queries(10)));
  EXPECT_TRUE(grid.packet({.vertices = 1600}).run(grid.queries(kInfinity)));
}

}  // namespace
}  // namespace meshhood::test
