// SPDX-License-Identifier: MIT
#include "exact/build/edge_source.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

using EdgeSet = std::set<std::pair<VertexId, VertexId>>;

/// The edges of a source, read in parts of `part` polygons or rows.
EdgeSet edge_set_of(const EdgeSource& source, std::size_t part) {
  EdgeSet result;
  for (std::size_t begin = 0; begin < source.size(); begin += part) {
    source.for_each(begin, std::min(begin + part, source.size()), [&](VertexId v, VertexId w) {
      EXPECT_NE(v, w);
      result.emplace(std::min(v, w), std::max(v, w));
    });
  }
  return result;
}

EdgeSet edge_set_of(const AdjacencyView& graph) {
  EdgeSet result;
  for (VertexId v = 0; v < graph.size(); ++v) {
    for (const VertexId w : graph[v]) result.emplace(std::min(v, w), std::max(v, w));
  }
  return result;
}

class EdgeSourceOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(EdgeSourceOfFamilies, PolygonsAndRowsHaveTheEdgesOfTheGraphInAnyParts) {
  for (const std::size_t vertices : {1U, 50U, 2000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 2, vertices);
    const Adjacency graph = adjacency(mesh.view());
    const EdgeSet expected = edge_set_of(graph.view());
    for (const std::size_t part : {1U, 7U, 300U, 100000U}) {
      ASSERT_EQ(edge_set_of(EdgeSource(mesh.view().faces), part), expected);
      ASSERT_EQ(edge_set_of(EdgeSource(graph.view()), part), expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EdgeSource, EdgeSourceOfFamilies, testing::ValuesIn(families()), family_name);

TEST(EdgeSource, ConvertsCornersOf64BitsAndStridedOnesInAnyParts) {
  const TestMesh mesh = make_grid(30, 30, false).finish(true);
  const Adjacency graph = adjacency(mesh.view());
  const EdgeSet expected = edge_set_of(graph.view());
  std::vector<std::uint64_t> rows;
  mesh.view().faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    ASSERT_EQ(corners.size(), 3U);
    rows.insert(rows.end(), corners.begin(), corners.end());
  });
  std::vector<std::int32_t> columns(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) columns[i % 3 * (rows.size() / 3) + i / 3] = static_cast<int>(rows[i]);
  for (const std::size_t part : {1U, 255U, 256U, 257U, 100000U}) {
    EXPECT_EQ(edge_set_of(EdgeSource(FacesView::triangles(rows)), part), expected);
    EXPECT_EQ(edge_set_of(EdgeSource(FacesView::column_major_triangles(columns)), part), expected);
  }
}

}  // namespace
}  // namespace meshhood::test
