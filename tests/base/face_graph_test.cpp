// SPDX-License-Identifier: MIT
// The graph of the faces, against a comparison of all pairs of faces.
#include "meshhood/face_graph.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

std::set<std::pair<VertexId, VertexId>> sides_of(std::span<const std::uint32_t> face) {
  std::set<std::pair<VertexId, VertexId>> sides;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const auto side = std::minmax(face[i], face[(i + 1) % face.size()]);
    if (side.first != side.second) sides.emplace(side.first, side.second);
  }
  return sides;
}

MESHHOOD_SUITE_OF_FAMILIES(FaceGraphIn);

TEST_P(FaceGraphIn, JoinsTheFacesThatHaveASideInCommon) {
  for (const std::size_t vertices : {1U, 40U, 200U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    const auto has_corners = [&](std::size_t f) { return !mesh.face(f).empty(); };
    bool all_have_corners = true;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) all_have_corners = all_have_corners && has_corners(f);
    if (!all_have_corners) {
      expect_refused(ErrorCode::InvalidMesh, "has no corners", [&] { return face_graph(mesh.view()); });
      continue;
    }
    const GraphData graph = face_graph(mesh.view());
    validate(graph.view());
    ASSERT_EQ(graph.adjacency.view().size(), mesh.face_count());
    const auto& centers = std::get<std::vector<double>>(graph.positions);
    std::vector<std::set<std::pair<VertexId, VertexId>>> sides;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) sides.push_back(sides_of(mesh.face(f)));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<VertexId> expected;
      for (std::size_t g = 0; g < mesh.face_count(); ++g) {
        const bool meet = std::ranges::any_of(sides[f], [&](const auto& side) { return sides[g].count(side) != 0; });
        if (f != g && meet) expected.push_back(static_cast<VertexId>(g));
      }
      ASSERT_THAT(graph.adjacency.view()[f], testing::ElementsAreArray(expected)) << mesh.name << ", face " << f;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = kInfinity;
        double high = -kInfinity;
        for (const std::uint32_t v : mesh.face(f)) {
          low = std::min(low, mesh.positions[3 * std::size_t{v} + axis]);
          high = std::max(high, mesh.positions[3 * std::size_t{v} + axis]);
        }
        const double slack = 1e-15 * std::max(std::abs(low), std::abs(high)) * static_cast<double>(mesh.face(f).size());
        ASSERT_GE(centers[3 * f + axis], low - slack);
        ASSERT_LE(centers[3 * f + axis], high + slack);
      }
    }
  }
}

TEST(FaceGraph, JoinsFacesOnceThatHaveSeveralSidesInCommon) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(1, 0, 0);
  mesh.add_vertex(1, 1, 0);
  mesh.add_vertex(0, 1, 0);
  mesh.add_face({0, 1, 2, 3});
  mesh.add_face({0, 1, 2});
  mesh.add_face({2, 1, 0});
  const GraphData graph = face_graph(mesh.finish(true).view());
  EXPECT_THAT(graph.adjacency.view()[0], testing::ElementsAre(1, 2));
  EXPECT_THAT(graph.adjacency.view()[1], testing::ElementsAre(0, 2));
  EXPECT_THAT(graph.adjacency.view()[2], testing::ElementsAre(0, 1));
}

TEST(FaceGraph, HasTheMeanOfTheCorners) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(4, 0, 0);
  mesh.add_vertex(4, 8, 0);
  mesh.add_vertex(0, 8, 4);
  mesh.add_face({0, 1, 2, 3});
  const GraphData graph = face_graph(mesh.finish(true).view());
  EXPECT_THAT(std::get<std::vector<double>>(graph.positions), testing::ElementsAre(2, 4, 1));
}

}  // namespace
}  // namespace meshhood::test
