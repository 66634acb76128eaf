// SPDX-License-Identifier: MIT
// Curvatures and features with walls are those of an index that was built without the edges at the walls.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/curvature.h"
#include "meshhood/features.h"
#include "meshhood/masks.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/without_walls.h"

namespace meshhood::test {
namespace {

/// A wavy sheet with normals and walls, and the index that was built without the walls.
class WithWalls : public testing::Test {
 protected:
  static TestMesh wavy() {
    TestMesh mesh = make_grid(50, 50, false).finish(false);
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      mesh.positions[3 * v + 2] = 2 * std::sin(mesh.positions[3 * v] / 4) * std::cos(mesh.positions[3 * v + 1] / 5);
    }
    return mesh;
  }

  std::vector<double> draw_normals() {
    std::vector<double> result;
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      for (const double component : {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 1.0}) {
        result.push_back(component);
      }
    }
    return result;
  }

  /// Some scattered walls, a line that divides the sheet, and a few vertices that only walls surround.
  std::vector<std::uint8_t> draw_walls() {
    std::vector<std::uint8_t> result = draw_mask(random, mesh.size(), 20);
    for (std::size_t i = 0; i < 50; ++i) result[50 * 23 + i] = 1;
    for (std::size_t i = 10; i < 13; ++i) {
      for (std::size_t k = 10; k < 14; ++k) result[50 * i + k] = i == 11 && (k == 11 || k == 12) ? 0 : 1;
    }
    return result;
  }

  [[nodiscard]] Index build_without_walls() const {
    const Adjacency graph = without_walls(mesh, walls);
    return build(GraphView{mesh.positions_view(), graph.view()});
  }

  /// Both have `columns` numbers for each vertex.
  void expect_same(const std::vector<double>& found, const std::vector<double>& expected, std::size_t columns,
                   double tolerance) const {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (walls[i / columns % mesh.size()] != 0) continue;
      if (std::isnan(expected[i])) {
        ASSERT_TRUE(std::isnan(found[i])) << "number " << i;
      } else {
        ASSERT_NEAR(found[i], expected[i], tolerance * (1 + std::abs(expected[i]))) << "number " << i;
      }
    }
  }

  Random random{17};
  TestMesh mesh = wavy();
  std::vector<std::uint8_t> walls = draw_walls();
  std::vector<double> normals = draw_normals();
  Index index = build(mesh.view());
  Index expected_index = build_without_walls();
  Index with_walls = masked(index, {.walls = walls});
};

TEST_F(WithWalls, CurvaturesAreThoseWithoutTheEdgesAtWalls) {
  const Surface surface = Surface::of_normals(with_walls, normals);
  const Surface expected_surface = Surface::of_normals(expected_index, normals);
  for (const double radius : {1.0, 4.0}) {  // at the smaller one, many neighborhoods are extended
    for (const CurvatureFit fit : {CurvatureFit::Quadric, CurvatureFit::Jet}) {
      const CurvatureOptions options{.fit = fit};
      const Curvatures found = curvatures(surface, {.radius = radius}, options);
      const Curvatures expected = curvatures(expected_surface, {.radius = radius}, options);
      expect_same(found.k1, expected.k1, 1, 1e-6);
      expect_same(found.k2, expected.k2, 1, 1e-6);
      for (std::size_t v = 0; v < mesh.size(); ++v) {
        ASSERT_EQ(found.state[v], walls[v] != 0 ? CurvatureState::TooFew : expected.state[v]) << "vertex " << v;
      }
    }
  }
}

TEST_F(WithWalls, FeaturesHaveScalesOrARadiusForEachRow) {
  const Surface surface = Surface::of_normals(with_walls, normals);
  const Surface expected_surface = Surface::of_normals(expected_index, normals);
  const std::vector<double> areas(mesh.size(), 0.5);
  const FeatureOptions options{.kinds = {Feature::Mean, Feature::Height}, .areas = areas};
  const BatchRadius scales = BatchRadius::scales({2, 4});
  const std::vector<double> found = features(surface, {.radius = scales}, options);
  expect_same(found, features(expected_surface, {.radius = scales}, options), 2, 1e-6);
  std::vector<double> radii(mesh.size(), 2.0);
  for (std::size_t v = 0; v < mesh.size(); v += 3) radii[v] = 4;
  const std::vector<double> by_row = features(surface, {.radius = radii}, options);
  ASSERT_EQ(by_row.size(), found.size() / 2);
  for (std::size_t i = 0; i < by_row.size(); ++i) {
    const double expected = found[(radii[i / 2] == 4 ? by_row.size() : 0) + i];
    if (!std::isnan(expected)) {
      ASSERT_NEAR(by_row[i], expected, 1e-9 * (1 + std::abs(expected)));
    }
  }
}

TEST_F(WithWalls, CorrectedCurvaturesHaveScalesOrARadiusForEachRow) {
  const Surface surface(with_walls, mesh.view());
  const CorrectedCurvatures scaled = corrected_curvatures(surface, {.radius = BatchRadius::scales({2, 4})});
  const CorrectedCurvatures small = corrected_curvatures(surface, {.radius = 2});
  const CorrectedCurvatures large = corrected_curvatures(surface, {.radius = 4});
  std::vector<double> radii(mesh.size(), 2.0);
  for (std::size_t v = 0; v < mesh.size(); v += 3) radii[v] = 4;
  const CorrectedCurvatures by_row = corrected_curvatures(surface, {.radius = radii});
  ASSERT_EQ(scaled.area.size(), 2 * mesh.size());
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    ASSERT_EQ(scaled.area[v], small.area[v]);
    ASSERT_EQ(scaled.area[mesh.size() + v], large.area[v]);
    ASSERT_EQ(by_row.area[v], radii[v] == 4 ? large.area[v] : small.area[v]);
    if (walls[v] != 0) {
      ASSERT_EQ(small.area[v], 0);
      ASSERT_TRUE(std::isnan(small.mean[v]));
    }
  }
}

}  // namespace
}  // namespace meshhood::test
