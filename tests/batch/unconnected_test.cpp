// SPDX-License-Identifier: MIT
// The nearest vertices that are not connected, against a scan of all vertices. With masks: whole/metrics_test.cpp.
#include "meshhood/unconnected.h"

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/start.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/oracle.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/sheets.h"

namespace meshhood::test {
namespace {

/// The first by distance, then by id, of the vertices in the ball that are not in the neighborhood.
NearestVertex scan(const Oracle& oracle, VertexId v, double radius) {
  std::vector<bool> is_connected(oracle.size());
  for (const VertexId w : oracle.exact(v, radius)) is_connected[w] = true;
  NearestVertex best{kNoVertex, kInfinity};
  for (VertexId w = 0; w < oracle.size(); ++w) {
    const double distance = oracle.distance(v, w);
    if (is_connected[w] || !(distance <= radius) || (best.vertex != kNoVertex && distance >= best.distance)) continue;
    best = {w, distance};
  }
  return best;
}

MESHHOOD_SUITE_OF_FAMILIES(UnconnectedFamilies);

TEST_P(UnconnectedFamilies, AreTheFirstOfAScan) {
  std::size_t rows = 0;
  std::size_t found = 0;
  for (const std::size_t vertices : {1U, 40U, 300U, 700U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    Random random(vertices);
    const double edge = oracle.mean_edge();
    for (const double radius : {0.0, 2 * edge, 7 * edge, kInfinity}) {
      std::vector<double> radii(mesh.size(), radius);
      // A vertex at exactly the radius counts.
      const auto pick = [&] { return static_cast<VertexId>(random.below(mesh.size())); };
      for (int i = 0; i < 5; ++i) {
        const VertexId v = pick();
        radii[v] = oracle.distance(v, pick());
      }
      const Unconnected result = nearest_unconnected(index, {.radius = radii}, {.threads = 2});
      for (VertexId v = 0; v < mesh.size(); v += static_cast<VertexId>(1 + mesh.size() / scaled(150, 20))) {
        const NearestVertex expected = scan(oracle, v, radii[v]);
        ASSERT_EQ(result.vertex[v], expected.vertex) << mesh.name << ", vertex " << v << ", radius " << radii[v];
        ASSERT_EQ(result.distance[v], expected.distance) << mesh.name << ", vertex " << v << ", radius " << radii[v];
        ++rows;
        found += static_cast<std::size_t>(expected.vertex != kNoVertex);
      }
    }
  }
  std::printf("%s: %zu rows, %zu with a vertex\n", std::string(GetParam().name).c_str(), rows, found);
}

// At the larger radii some vertices of a leaf reach the other half around the fold, others of the leaf do not.
TEST(Unconnected, OfAFoldedSheetAreThoseOfAScan) {
  const auto [mesh, index] = indexed(make_folded_sheet(24));
  const Oracle oracle(mesh);
  const std::vector<double> radii{3.0, 8.0, 10.0, 12.0};
  const Unconnected result = nearest_unconnected(index, {.radius = BatchRadius::scales(radii)});
  for (std::size_t row = 0; row < radii.size() * mesh.size(); ++row) {
    const auto v = static_cast<VertexId>(row % mesh.size());
    const NearestVertex expected = scan(oracle, v, radii[row / mesh.size()]);
    ASSERT_EQ(result.vertex[row], expected.vertex) << v;
    ASSERT_EQ(result.distance[row], expected.distance) << v;
  }
}

TEST(Unconnected, RefusesARowThatDoesNotExistAndARadiusThatIsNone) {
  const auto [mesh, index] = indexed(make_grid(5, 5, false));
  const std::vector<VertexId> vertices{3, 25};
  expect_refused(ErrorCode::VertexOutOfRange, "row 1: vertex 25",
                 [&] { return nearest_unconnected(index, {.vertices = vertices, .radius = 1}); });
  expect_refused(ErrorCode::InvalidRadius, "-1", [&] { return nearest_unconnected(index, {.radius = -1.0}); });
  expect_refused(ErrorCode::InvalidRadius, "nan", [&] { return nearest_unconnected(index, {}); });
}

}  // namespace
}  // namespace meshhood::test
