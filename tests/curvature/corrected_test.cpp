// SPDX-License-Identifier: MIT
// Corrected curvature measures, compared with the formulas of spheres and cylinders.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/curvature.h"
#include "meshhood/index.h"

#include "exact/index_access.h"
#include "support/families.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/test_mesh.h"
#include "surface/surface.h"

namespace meshhood::test {
namespace {

/// A cylinder of this radius along z, of triangles or quads, normals outward.
TestMesh cylinder(double radius, bool quads) {
  TestMesh mesh;
  for (std::size_t i = 0; i < 90; ++i) {
    for (std::size_t j = 0; j < 40; ++j) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 90;
      mesh.add_vertex(radius * std::cos(angle), radius * std::sin(angle), 0.07 * radius * static_cast<double>(j));
    }
  }
  add_grid_faces(mesh, {.rows = 90, .regions = 40, .closed_rows = false, .closed_columns = true, .quads = quads});
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.offsets[f]),
                 mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.offsets[f + 1]));
  }
  return mesh.finish(false);
}

TEST(CorrectedCurvature, OfACylinderIsThatOfTheFormula) {
  for (const bool quads : {false, true}) {
    const double radius = 4;
    const auto [mesh, index, surface] = with_surface(cylinder(radius, quads));
    const std::vector<VertexId> rows{40 * 30 + 20, 40 * 61 + 18};
    const CorrectedCurvatures found = corrected_curvatures(surface, {rows, 0.8});
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const double* const p = &mesh.positions[3 * rows[row]];
      EXPECT_NEAR(found.k1[row], 1 / radius, 0.004) << "the other normals of the patch are tilted";
      EXPECT_NEAR(found.k2[row], 0, 0.002);
      EXPECT_NEAR(found.mean[row], 0.5 / radius, 0.001);
      EXPECT_NEAR(found.gaussian[row], 0, 1e-9);
      EXPECT_NEAR(found.area[row] / (std::numbers::pi * 0.64), 1, 0.2);
      const double around = (-p[1] * found.d1[3 * row] + p[0] * found.d1[3 * row + 1]) / radius;
      EXPECT_NEAR(std::abs(around), 1, 1e-3);
      EXPECT_NEAR(found.d2[3 * row + 2], 1, 1e-3);
    }
  }
}

TEST(CorrectedCurvature, OfNormalsThatPointToTheOtherSideIsStillOrdered) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(15).finish(false));
  std::vector<double> opposite;
  for (VertexId v = 0; v < mesh.size(); ++v) {
    const Point n = SurfaceAccess::oriented(surface).normal(IndexAccess::view(index).place(v));
    for (const double component : {-n.x, -n.y, -n.z}) opposite.push_back(component);
  }
  const auto found = corrected_curvatures(Surface::of_normals(index, opposite, mesh.view().faces), {{}, 3.0});
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    ASSERT_LT(found.area[v], 0);
    ASSERT_GE(found.k1[v], found.k2[v]);
  }
}

TEST(CorrectedCurvature, ScalesWithTheMeshBitForBit) {
  const auto [mesh, index] = indexed(bumpy_grid(12).finish(false));
  const auto expected = corrected_curvatures(Surface(index, mesh.view()), {{}, 3.0});
  for (const int exponent : {-300, 300}) {
    TestMesh other = mesh;
    for (double& x : other.positions) x = std::ldexp(x, exponent);
    const Index of_other = build(other.view());
    const auto found =
        corrected_curvatures(Surface(of_other, other.view()), {{}, std::ldexp(3.0, exponent)}, {.threads = 2});
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      ASSERT_EQ(std::ldexp(found.k1[v], exponent), expected.k1[v]);
      ASSERT_EQ(std::ldexp(found.mean[v], exponent), expected.mean[v]);
      const auto measures = [v](const CorrectedCurvatures& of) { return std::span(of.measures).subspan(12 * v, 12); };
      ASSERT_EQ(std::ldexp(measures(found)[0], -2 * exponent), measures(expected)[0]) << "an area";
      ASSERT_EQ(measures(found)[2], measures(expected)[2]) << "a solid angle";
      for (const std::size_t i : {1U, 3U, 7U, 11U}) {
        ASSERT_EQ(std::ldexp(measures(found)[i], -exponent), measures(expected)[i]) << "a length";
      }
    }
    EXPECT_EQ(found.d2, expected.d2);
  }
}

TEST(CorrectedCurvature, FollowsFromItsMeasures) {
  const auto [mesh, index] = indexed(bumpy_grid(12).finish(false));
  const auto found = corrected_curvatures(Surface(index, mesh.view()), {{}, 3.0});
  ASSERT_EQ(found.measures.size(), 12 * mesh.size());
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    const auto m = std::span(found.measures).subspan(12 * v, 12);
    EXPECT_EQ(found.area[v], m[0]);
    EXPECT_NEAR(found.mean[v], m[1] / (2 * m[0]), 1e-14);
    EXPECT_NEAR(found.gaussian[v], m[2] / m[0], 1e-14);
    const auto quotient = [&](const std::vector<double>& d) {
      double sum = 0;
      for (std::size_t i = 0; i < 9; ++i) sum += d[3 * v + i / 3] * m[3 + i] * d[3 * v + i % 3];
      return sum / m[0];
    };
    EXPECT_NEAR(quotient(found.d1), -found.k1[v], 1e-12);
    EXPECT_NEAR(quotient(found.d2), -found.k2[v], 1e-12);
  }
}

TEST(CorrectedCurvature, OfAVertexWithoutFacesIsNan) {
  TestMesh mesh = bumpy_grid(6);
  mesh.add_vertex(100, 0, 0);
  mesh.finish(false);
  const Index index = build(mesh.view());
  const auto found = corrected_curvatures(Surface(index, mesh.view()), {{}, 2.0});
  EXPECT_EQ(found.area[36], 0);
  EXPECT_TRUE(std::isnan(found.mean[36]) && std::isnan(found.k1[36]) && std::isnan(found.d1[3 * 36]));
  EXPECT_FALSE(std::isnan(found.k1[0]));
}

TEST(CorrectedCurvature, RefusesInvalidArgumentsAndNamesThem) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(6).finish(false));
  const std::vector<VertexId> outside{36};
  const std::vector<std::uint32_t> corners{0, 1, 99};
  expect_refused(ErrorCode::InvalidRadius, "-1", [&] { return corrected_curvatures(surface, {{}, -1.0}); });
  expect_refused(ErrorCode::VertexOutOfRange, "36", [&] { return corrected_curvatures(surface, {outside, 1.0}); });
  expect_refused(ErrorCode::InvalidMesh, "99",
                 [&] { return corrected_curvatures(Surface(index, FacesView::triangles(corners)), {{}, 1.0}); });
}

}  // namespace
}  // namespace meshhood::test
