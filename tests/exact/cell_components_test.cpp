// SPDX-License-Identifier: MIT
#include "exact/build/cell_components.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "base/frame.h"
#include "exact/layout.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

/// The vertices of a mesh in kd order, and its graph.
struct Cells {
  explicit Cells(const TestMesh& mesh, unsigned threads = 1)
      : task(threads, silent, 0),
        adjacency(meshhood::adjacency(mesh.view())),
        points(kd_points(mesh)),
        graph((kd_order(points, kCellSize), points), adjacency.view(), task) {}

  static std::vector<KdPoint> kd_points(const TestMesh& mesh) {
    const Frame frame = make_frame(mesh.positions_view());
    std::vector<KdPoint> result;
    for (std::uint32_t v = 0; v < mesh.size(); ++v) {
      const FramePoint p = frame.round(point(mesh.positions_view(), v));
      result.push_back({{p.x, p.y, p.z}, v});
    }
    return result;
  }

  [[nodiscard]] std::vector<std::size_t> neighbors(std::size_t i) const {
    std::vector<std::size_t> result;
    graph.for_each_neighbor(i, [&](std::size_t other) { result.push_back(other); });
    return result;
  }

  Progress silent;
  TaskContext task;
  Adjacency adjacency;
  std::vector<KdPoint> points;
  CellGraph graph;
};

/// For each vertex in kd order the first vertex that is connected to it within its cell.
std::vector<std::size_t> connected_within_cells(const Cells& cells) {
  std::vector<std::size_t> first(cells.graph.size());
  std::iota(first.begin(), first.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (const std::size_t other : cells.neighbors(i)) {
        if (other / kCellSize != i / kCellSize || first[other] >= first[i]) continue;
        first[i] = first[other];
        changed = true;
      }
    }
  }
  return first;
}

std::vector<std::uint32_t> sizes_of(const CellComponents& components) {
  std::vector<std::uint32_t> result(components.size.size());
  for (const std::uint32_t c : components.of) ++result[c];
  return result;
}

class CellComponentsOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(CellComponentsOfFamilies, ComponentsOfCellsAreThoseOfTheGraphWithinEachCell) {
  std::size_t count = 0;
  for (const std::size_t vertices : {1U, 50U, 2000U}) {
    Cells cells(make_mesh(GetParam(), 3, vertices));
    const CellComponents components = split_cells(cells.graph, cells.task);
    const std::vector<std::size_t> expected = connected_within_cells(cells);
    ASSERT_EQ(components.of.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::uint32_t c = components.of[i];
      ASSERT_EQ(c, components.of[expected[i]]) << "vertices connected within a cell";
      ASSERT_GE(c, components.first[i / kCellSize]) << "numbered by cell";
      ASSERT_LT(c, components.first[i / kCellSize + 1]) << "numbered by cell";
    }
    const std::size_t roots = static_cast<std::size_t>(std::count_if(
        expected.begin(), expected.end(), [&, i = std::size_t{0}](std::size_t e) mutable { return e == i++; }));
    ASSERT_EQ(components.size.size(), roots) << "vertices not connected lie in different components";
    ASSERT_EQ(components.size, sizes_of(components));
    count += roots;
  }
  std::printf("%s: %zu components\n", std::string(GetParam().name).c_str(), count);
}

TEST_P(CellComponentsOfFamilies, TheFirstComponentOfACellIsTheLargest) {
  Cells cells(make_mesh(GetParam(), 4, 1000));
  const CellComponents components = split_cells(cells.graph, cells.task);
  for (std::size_t cell = 0; cell < cells.graph.cells(); ++cell) {
    for (std::uint32_t c = components.first[cell]; c < components.first[cell + 1]; ++c) {
      ASSERT_LE(components.size[c], components.size[components.first[cell]]);
    }
  }
}

TEST_P(CellComponentsOfFamilies, MergingKeepsComponentsTogetherAndFillsNoLeafOverItsCapacity) {
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    Cells cells(make_mesh(GetParam(), 5, vertices));
    const CellComponents before = split_cells(cells.graph, cells.task);
    CellComponents after = before;
    merge_small(cells.graph, after);
    std::vector<std::uint32_t> moved_to(before.size.size(), 0);
    for (std::size_t i = 0; i < before.of.size(); ++i) moved_to[before.of[i]] = after.of[i];
    for (std::size_t i = 0; i < before.of.size(); ++i) ASSERT_EQ(after.of[i], moved_to[before.of[i]]);
    ASSERT_EQ(after.size, sizes_of(after));
    for (const std::uint32_t size : after.size) ASSERT_LE(size, kLeafCapacity);
  }
}

TEST_P(CellComponentsOfFamilies, AComponentStaysSmallOnlyIfNoNeighborHasRoom) {
  Cells cells(make_mesh(GetParam(), 6, 3000));
  const CellComponents before = split_cells(cells.graph, cells.task);
  CellComponents after = before;
  merge_small(cells.graph, after);
  for (std::size_t i = 0; i < after.of.size(); ++i) {
    const std::uint32_t c = after.of[i];
    // Nothing has been merged into it, so that it had this size when it was its turn.
    if (after.size[c] >= kSmallComponent || before.of[i] != c || before.size[c] != after.size[c]) continue;
    for (const std::size_t other : cells.neighbors(i)) {
      if (after.of[other] == c) continue;
      ASSERT_GT(after.size[c] + after.size[after.of[other]], kLeafCapacity) << "component " << c;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CellComponents, CellComponentsOfFamilies, testing::ValuesIn(families()), family_name);

TEST(CellComponents, PointsWithoutEdgesFillLeavesInTheOrderOfTheCells) {
  TestMesh mesh;
  Random random(1);
  for (int i = 0; i < 300; ++i) mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
  Cells cells(mesh.finish(true));
  CellComponents components = split_cells(cells.graph, cells.task);
  EXPECT_EQ(components.size.size(), 300U);
  merge_small(cells.graph, components);
  const auto leaves = std::count_if(components.size.begin(), components.size.end(), [](auto size) { return size > 0; });
  EXPECT_EQ(leaves, 10);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(components.of[i], components.of[i / kLeafCapacity * kLeafCapacity]);
}

/// Two sheets of `columns` columns, so near to each other that cells hold vertices of both.
TestMesh two_sheets(std::size_t columns) {
  TestMesh mesh = make_grid(4, columns, false);
  TestMesh other = mesh;
  for (std::size_t i = 2; i < other.positions.size(); i += 3) other.positions[i] = 0.01;
  append(mesh, other);
  return mesh.finish(true);
}

TEST(CellComponents, SmallComponentsOfTheMeshShareNoLeafWithASurface) {
  TestMesh mesh = make_grid(30, 30, false);
  Random random(2);
  for (int i = 0; i < 40; ++i) mesh.add_vertex(random.uniform(0, 30), random.uniform(0, 30), 0.1);
  Cells cells(mesh.finish(true));
  CellComponents components = split_cells(cells.graph, cells.task);
  merge_small(cells.graph, components);
  std::vector<int> is_crumb(components.size.size(), -1);
  for (std::size_t i = 0; i < components.of.size(); ++i) {
    int& known = is_crumb[components.of[i]];
    const int mine = cells.points[i].id < 900 ? 0 : 1;
    EXPECT_TRUE(known == -1 || known == mine) << "vertex " << cells.points[i].id;
    known = mine;
  }
}

TEST(CellComponents, SheetsThatTouchInSpaceAreNotMerged) {
  Cells cells(two_sheets(300));
  CellComponents components = split_cells(cells.graph, cells.task);
  merge_small(cells.graph, components);
  std::vector<int> sheet(components.size.size(), -1);
  for (std::size_t i = 0; i < components.of.size(); ++i) {
    int& known = sheet[components.of[i]];
    const int mine = cells.points[i].id < 1200 ? 0 : 1;
    EXPECT_TRUE(known == -1 || known == mine) << "vertex " << cells.points[i].id;
    known = mine;
  }
  const auto leaves = std::count_if(components.size.begin(), components.size.end(), [](auto size) { return size > 0; });
  std::printf("%td leaves of 2400 vertices\n", leaves);
  EXPECT_LE(leaves, 2400 / static_cast<std::ptrdiff_t>(kSmallComponent)) << "small components are merged";
}

/// Three cells on a line, each a path. The first two vertices of the middle cell are cut off from the rest of it, and
/// have `left` edges to the first cell and `right` edges to the last, at most two each.
CellComponents merged_pair(std::size_t left, std::size_t right) {
  std::vector<KdPoint> points;
  for (std::uint32_t v = 0; v < 3 * kCellSize; ++v) points.push_back({{static_cast<float>(v), 0, 0}, v});
  const auto pair = static_cast<VertexId>(kCellSize);
  std::vector<std::set<VertexId>> neighbors(points.size());
  const auto join = [&](VertexId v, VertexId w) {
    neighbors[v].insert(w);
    neighbors[w].insert(v);
  };
  for (VertexId v = 0; v + 1 < points.size(); ++v) {
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
  const Progress silent;
  TaskContext task(1, silent, 0);
  const CellGraph graph(points, adjacency.view(), task);
  CellComponents components = split_cells(graph, task);
  merge_small(graph, components);
  return components;
}

TEST(CellComponents, ASmallComponentJoinsTheNeighborWithMostEdgesToIt) {
  const CellComponents left = merged_pair(2, 1);
  EXPECT_EQ(left.of[kCellSize], left.of[0]);
  EXPECT_EQ(left.size[left.of[0]], kCellSize + 2);
  const CellComponents right = merged_pair(1, 2);
  EXPECT_EQ(right.of[kCellSize], right.of[2 * kCellSize]);
}

TEST(CellComponents, AreTheSameForAnyNumberOfThreads) {
  const TestMesh mesh = two_sheets(5000);
  Cells one(mesh);
  const CellComponents expected = split_cells(one.graph, one.task);
  for (const unsigned threads : {2U, 5U}) {
    Cells cells(mesh, threads);
    const CellComponents components = split_cells(cells.graph, cells.task);
    EXPECT_EQ(components.of, expected.of);
    EXPECT_EQ(components.first, expected.first);
    EXPECT_EQ(components.size, expected.size);
  }
}

}  // namespace
}  // namespace meshhood::test
