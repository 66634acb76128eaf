// SPDX-License-Identifier: MIT
#include "exact/build/cells.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

class CellsOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(CellsOfFamilies, HoldEveryVertexOnceInAscendingOrder) {
  for (const std::size_t vertices : {1U, 30U, 31U, 2000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 2, vertices);
    TaskContext task;
    const Cells cells = make_cells(mesh.positions_view(), make_frame(mesh.positions_view()), task);
    ASSERT_EQ(cells.size(), (mesh.size() + kCellSize - 1) / kCellSize);
    ASSERT_EQ(cells.slot.size(), mesh.size());
    std::vector<bool> seen(mesh.size(), false);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      ASSERT_EQ(cells.size_of(cell), cell + 1 < cells.size() ? kCellSize : mesh.size() - kCellSize * cell);
      for (unsigned lane = 0; lane < cells.size_of(cell); ++lane) {
        const VertexId v = cells.point(cell, lane).id;
        ASSERT_FALSE(seen[v]);
        seen[v] = true;
        ASSERT_EQ(cells.slot[v], kLeafCapacity * cell + lane);
        ASSERT_TRUE(lane == 0 || cells.point(cell, lane - 1).id < v);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, CellsOfFamilies, testing::ValuesIn(families()), family_name);

TEST(Cells, ThereAreNoneWithoutVertices) {
  TaskContext task;
  EXPECT_EQ(make_cells(PositionsView(), Frame{}, task).size(), 0U);
}

}  // namespace
}  // namespace meshhood::test
