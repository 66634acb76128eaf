// SPDX-License-Identifier: MIT
#include "exact/build/cell_components.h"

#include <bit>
#include <cstdio>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "base/frame.h"
#include "exact/layout.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

/// The cells of a mesh, and its graph.
struct Divided {
  explicit Divided(const TestMesh& mesh, unsigned threads = 1)
      : Divided(mesh.positions_view(), meshhood::adjacency(mesh.view()), threads) {}

  Divided(const PositionsView& positions, Adjacency graph, unsigned threads)
      : adjacency(std::move(graph)), cells(make_cells(positions, make_frame(positions), task)) {
    const Progress silent;
    TaskContext on_threads(threads, silent, 0);
    links = make_links(EdgeSource(adjacency.view()), cells.slot, cells.begin, on_threads);
    components = split_cells(cells, links, on_threads);
    leaves = merge_small(components, links, on_threads);
    for (const KdPoint& p : cells.points) {
      const std::uint32_t slot = cells.slot[p.id];
      component_of.push_back(components.at(leaf_of(slot), lane_of(slot)));
      leaf_of_point.push_back(leaves.leaf_of[component_of.back()]);
    }
  }

  [[nodiscard]] std::size_t size() const { return cells.points.size(); }

  /// The points that an edge joins to point `i`.
  [[nodiscard]] std::vector<std::size_t> neighbors(std::size_t i) const {
    std::vector<std::size_t> result;
    for (const VertexId w : adjacency.view()[cells.points[i].id]) {
      result.push_back(std::size_t{cells.begin[leaf_of(cells.slot[w])]} + lane_of(cells.slot[w]));
    }
    return result;
  }

  [[nodiscard]] std::size_t size_of_component(std::size_t component) const {
    return count_of(components.values[component].lanes);
  }
  [[nodiscard]] std::size_t size_of_leaf(std::size_t leaf) const {
    std::size_t size = 0;
    for (const CellComponent& part : leaves[leaf]) size += count_of(part.lanes);
    return size;
  }

  TaskContext task;
  Adjacency adjacency;
  Cells cells;
  Links links;
  CellComponents components;
  MergedComponents leaves;
  std::vector<std::uint32_t> component_of;   // by point in kd order
  std::vector<std::uint32_t> leaf_of_point;  // by point in kd order
};

/// For each vertex in kd order the first vertex that is connected to it within its cell.
std::vector<std::size_t> connected_within_cells(const Divided& mesh) {
  std::vector<std::size_t> first(mesh.size());
  std::iota(first.begin(), first.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (const std::size_t other : mesh.neighbors(i)) {
        if (other / kCellSize != i / kCellSize || first[other] >= first[i]) continue;
        first[i] = first[other];
        changed = true;
      }
    }
  }
  return first;
}

class CellComponentsOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(CellComponentsOfFamilies, ComponentsOfCellsAreThoseOfTheGraphWithinEachCell) {
  std::size_t count = 0;
  for (const std::size_t vertices : {1U, 50U, 2000U}) {
    const Divided mesh(make_mesh(GetParam(), 3, vertices));
    const CellComponents& components = mesh.components;
    const std::vector<std::size_t> expected = connected_within_cells(mesh);
    std::vector<std::size_t> sizes(components.values.size());
    std::size_t roots = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::uint32_t c = mesh.component_of[i];
      ASSERT_EQ(c, mesh.component_of[expected[i]]) << "vertices connected within a cell";
      ASSERT_EQ(components.values[c].cell, i / kCellSize);
      ASSERT_GE(c, components.offsets[i / kCellSize]) << "numbered by cell";
      ASSERT_LT(c, components.offsets[i / kCellSize + 1]) << "numbered by cell";
      ++sizes[c];
      roots += expected[i] == i ? 1 : 0;
    }
    ASSERT_EQ(components.values.size(), roots) << "vertices not connected lie in different components";
    for (std::size_t c = 0; c < sizes.size(); ++c) ASSERT_EQ(sizes[c], mesh.size_of_component(c));
    count += roots;
  }
  std::printf("%s: %zu components\n", std::string(GetParam().name).c_str(), count);
}

TEST_P(CellComponentsOfFamilies, TheFirstComponentOfACellIsTheLargest) {
  const Divided mesh(make_mesh(GetParam(), 4, 1000));
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    for (std::uint32_t c = mesh.components.offsets[cell]; c < mesh.components.offsets[cell + 1]; ++c) {
      ASSERT_LE(mesh.size_of_component(c), mesh.size_of_component(mesh.components.offsets[cell]));
    }
  }
}

TEST_P(CellComponentsOfFamilies, EveryComponentIsAPartOfOneLeafAndNoLeafIsFilledOverItsCapacity) {
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const Divided mesh(make_mesh(GetParam(), 5, vertices));
    std::size_t parts = 0;
    for (std::uint32_t leaf = 0; leaf < mesh.leaves.size(); ++leaf) {
      ASSERT_FALSE(mesh.leaves[leaf].empty());
      ASSERT_LE(mesh.size_of_leaf(leaf), kLeafCapacity);
      for (const CellComponent& part : mesh.leaves[leaf]) {
        const std::uint32_t component =
            mesh.components.at(part.cell, static_cast<unsigned>(std::countr_zero(part.lanes)));
        ASSERT_EQ(mesh.components.values[component].lanes, part.lanes);
        ASSERT_EQ(mesh.leaves.leaf_of[component], leaf);
        ++parts;
      }
    }
    ASSERT_EQ(parts, mesh.components.values.size());
  }
}

TEST_P(CellComponentsOfFamilies, ALeafOfOneSmallComponentHasNoNeighborWithRoom) {
  const Divided mesh(make_mesh(GetParam(), 6, 3000));
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const std::uint32_t leaf = mesh.leaf_of_point[i];
    // Nothing has been merged into it, so that it had this size when it was its turn.
    if (mesh.leaves[leaf].size() > 1 || mesh.size_of_leaf(leaf) >= kSmallComponent) continue;
    for (const std::size_t other : mesh.neighbors(i)) {
      const std::uint32_t neighbor = mesh.leaf_of_point[other];
      if (neighbor == leaf) continue;
      ASSERT_GT(mesh.size_of_leaf(leaf) + mesh.size_of_leaf(neighbor), kLeafCapacity) << "leaf " << leaf;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CellComponents, CellComponentsOfFamilies, testing::ValuesIn(families()), family_name);

TEST(CellComponents, PointsWithoutEdgesFillLeavesInTheOrderOfTheCells) {
  TestMesh points;
  Random random(1);
  for (int i = 0; i < 300; ++i) points.add_vertex(random.uniform(), random.uniform(), random.uniform());
  const Divided mesh(points.finish(true));
  EXPECT_EQ(mesh.components.values.size(), 300U);
  EXPECT_EQ(mesh.leaves.size(), 10U);
  // The components of a cell are numbered from one to the next, not in the order of its lanes.
  for (std::uint32_t c = 0; c < 300; ++c) EXPECT_EQ(mesh.leaves.leaf_of[c], c / kLeafCapacity);
}

/// Two sheets of `columns` columns, so near to each other that cells hold vertices of both.
TestMesh two_sheets(std::size_t columns) {
  TestMesh mesh = make_grid(4, columns, false);
  TestMesh other = mesh;
  for (std::size_t i = 2; i < other.positions.size(); i += 3) other.positions[i] = 0.01;
  append(mesh, other);
  return mesh.finish(true);
}

/// Expects that no leaf has vertices below `first` as well as others.
void expect_apart(const Divided& mesh, VertexId first) {
  std::vector<int> known(mesh.leaves.size(), -1);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const int mine = mesh.cells.points[i].id < first ? 0 : 1;
    int& of_leaf = known[mesh.leaf_of_point[i]];
    EXPECT_TRUE(of_leaf == -1 || of_leaf == mine) << "vertex " << mesh.cells.points[i].id;
    of_leaf = mine;
  }
}

TEST(CellComponents, SmallComponentsOfTheMeshShareNoLeafWithASurface) {
  TestMesh mesh = make_grid(30, 30, false);
  Random random(2);
  for (int i = 0; i < 40; ++i) mesh.add_vertex(random.uniform(0, 30), random.uniform(0, 30), 0.1);
  expect_apart(Divided(mesh.finish(true)), 900);
}

TEST(CellComponents, SheetsThatTouchInSpaceAreNotMerged) {
  const Divided mesh(two_sheets(300));
  expect_apart(mesh, 1200);
  std::printf("%zu leaves of 2400 vertices\n", mesh.leaves.size());
  EXPECT_LE(mesh.leaves.size(), 2400 / std::size_t{kSmallComponent}) << "small components are merged";
}

/// Three cells on a line, each a path. The first two vertices of the middle cell are cut off from the rest of it, and
/// have `left` edges to the first cell and `right` edges to the last, at most two each.
Divided merged_pair(std::size_t left, std::size_t right) {
  std::vector<float> positions;
  for (std::size_t v = 0; v < 3 * kCellSize; ++v) positions.insert(positions.end(), {static_cast<float>(v), 0, 0});
  const auto pair = static_cast<VertexId>(kCellSize);
  std::vector<std::set<VertexId>> neighbors(3 * kCellSize);
  const auto join = [&](VertexId v, VertexId w) {
    neighbors[v].insert(w);
    neighbors[w].insert(v);
  };
  for (VertexId v = 0; v + 1 < neighbors.size(); ++v) {
    if ((v + 1) % kCellSize != 0 && v != pair + 1) join(v, v + 1);
  }
  for (std::size_t i = 0; i < left; ++i) join(pair, static_cast<VertexId>(i));
  for (std::size_t i = 0; i < right; ++i) join(pair + 1, static_cast<VertexId>(2 * kCellSize + i));
  Adjacency adjacency;
  adjacency.offsets = {0};
  for (const std::set<VertexId>& row : neighbors) {
    adjacency.neighbors.insert(adjacency.neighbors.end(), row.begin(), row.end());
    adjacency.offsets.push_back(static_cast<EdgeOffset>(adjacency.neighbors.size()));
  }
  return {positions, std::move(adjacency), 1};
}

TEST(CellComponents, ASmallComponentJoinsTheNeighborWithMostEdgesToIt) {
  const Divided left = merged_pair(2, 1);
  EXPECT_EQ(left.leaf_of_point[kCellSize], left.leaf_of_point[0]);
  EXPECT_EQ(left.size_of_leaf(left.leaf_of_point[0]), kCellSize + 2);
  const Divided right = merged_pair(1, 2);
  EXPECT_EQ(right.leaf_of_point[kCellSize], right.leaf_of_point[2 * kCellSize]);
}

TEST(CellComponents, AreTheSameForAnyNumberOfThreads) {
  const TestMesh sheets = two_sheets(5000);
  const Divided expected(sheets);
  for (const unsigned threads : {2U, 5U}) {
    const Divided mesh(sheets, threads);
    EXPECT_EQ(mesh.components.offsets, expected.components.offsets);
    EXPECT_EQ(mesh.component_of, expected.component_of);
    EXPECT_EQ(mesh.leaf_of_point, expected.leaf_of_point);
  }
}

}  // namespace
}  // namespace meshhood::test
