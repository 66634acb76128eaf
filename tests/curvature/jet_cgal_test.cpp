// SPDX-License-Identifier: MIT
// Jets have the curvatures of CGAL's Monge_via_jet_fitting.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "meshhood/curvature.h"
#include "meshhood/index.h"

#include "support/families.h"
#include "support/oracle.h"
#include "support/random.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Fitting = CGAL::Monge_via_jet_fitting<Kernel>;

/// A wavy sheet whose vertices are not evenly spaced.
TestMesh waves(std::size_t side) {
  Random random(4);
  TestMesh mesh = make_grid(side, side, false);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    double* const p = &mesh.positions[3 * v];
    p[0] += random.uniform(-0.3, 0.3);
    p[1] += random.uniform(-0.3, 0.3);
    p[2] = 2 * std::sin(0.35 * p[0]) * std::cos(0.25 * p[1]) + 0.4 * p[0] + random.uniform(-0.05, 0.05);
  }
  return mesh.finish(false);
}

Kernel::Point_3 position(const TestMesh& mesh, std::size_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

/// CGAL computes the curvatures at the first point.
Fitting::Monge_form monge_form(const TestMesh& mesh, const std::vector<std::uint32_t>& ids, std::uint32_t v) {
  std::vector<Kernel::Point_3> points{position(mesh, v)};
  for (const std::uint32_t w : ids) {
    if (w != v) points.push_back(position(mesh, w));
  }
  Fitting fitting;
  return fitting(points.begin(), points.end(), 2, 2);
}

double along(const Kernel::Vector_3& theirs, const double* ours) {
  return std::abs(theirs.x() * ours[0] + theirs.y() * ours[1] + theirs.z() * ours[2]);
}

TEST(Jet, HasTheCurvaturesOfCgal) {
  const TestMesh mesh = waves(40);
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  const Surface surface(index, mesh.view());
  double worst = 0;
  std::size_t rows = 0;
  for (const double radius : {2.5, 5.0, 9.0}) {
    const Curvatures ours = curvatures(surface, {.radius = radius}, {.filter = false, .fit = CurvatureFit::Jet});
    for (std::uint32_t v = 0; v < mesh.size(); v += 7) {
      const std::vector<std::uint32_t> ids = oracle.exact(v, radius);
      if (ids.size() < 8) continue;
      Fitting::Monge_form theirs = monge_form(mesh, ids, v);
      theirs.comply_wrt_given_normal({0, 0, 1});  // that of the faces
      const double k1 = -theirs.principal_curvatures(1);
      const double k2 = -theirs.principal_curvatures(0);
      const double size = std::max(std::abs(k1), std::abs(k2));
      worst = std::max({worst, std::abs(ours.k1[v] - k1) / size, std::abs(ours.k2[v] - k2) / size});
      EXPECT_NEAR(ours.k1[v], k1, 1e-10 * size) << "vertex " << v << ", radius " << radius;
      EXPECT_NEAR(ours.k2[v], k2, 1e-10 * size);
      if (k1 - k2 > 0.01 * size) {
        EXPECT_NEAR(along(theirs.minimal_principal_direction(), &ours.d1[3 * std::size_t{v}]), 1, 1e-9);
        EXPECT_NEAR(along(theirs.maximal_principal_direction(), &ours.d2[3 * std::size_t{v}]), 1, 1e-9);
      }
      ++rows;
    }
  }
  std::printf("%zu rows, worst relative difference %.1e\n", rows, worst);
  EXPECT_GT(rows, 500U);
}

}  // namespace
}  // namespace meshhood::test
