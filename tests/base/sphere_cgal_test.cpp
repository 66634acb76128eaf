// SPDX-License-Identifier: MIT
// Our bounding spheres compared with those of CGAL, which are the smallest: on random points, and on every cluster of
// meshes.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "meshhood/paper.h"

#include "base/sphere.h"
#include "paper/hierarchy.h"
#include "support/families.h"
#include "support/scale.h"
#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SmallestSphere = CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>>;

template <class Real>
double smallest_radius(std::span<const Real> xyz) {
  std::vector<Kernel::Point_3> points;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Point p = point(xyz, i);
    points.emplace_back(p.x, p.y, p.z);
  }
  SmallestSphere sphere(points.begin(), points.end());
  return sphere.radius();
}

/// The largest ratio of our radius to that of CGAL, and the number of compared spheres.
struct Ratio {
  double largest = 1;
  std::size_t spheres = 0;

  void add(double ours, double smallest) {
    if (smallest == 0) return;
    largest = std::max(largest, ours / smallest);
    ++spheres;
  }

  void print(const std::string& name) const {
    std::printf("%s: %zu spheres, at most %.5f %% larger than the smallest\n", name.c_str(), spheres,
                100 * (largest - 1));
  }
};

TEST(SphereCgal, RandomPoints) {
  Random random(1);
  Ratio ratio;
  for (std::size_t i = 0; i < scaled(20000, 200); ++i) {
    std::vector<double> xyz(3 * (2 + random.below(i % 10 == 0 ? 500 : 30)));
    const double flat = i % 3 == 0 ? 1e-3 : 1;
    for (std::size_t k = 0; k < xyz.size(); ++k) xyz[k] = random.uniform(-1, 1) * (k % 3 == 2 ? flat : 1);
    const std::span<const double> points(xyz);
    ratio.add(bounding_sphere(points).radius, smallest_radius(points));
  }
  ratio.print("random points");
  EXPECT_LE(ratio.largest, 1.001 * (1 + 1e-9));
  EXPECT_GE(ratio.spheres, 200U);
}

/// Every cluster of every level of an index.
template <class Real>
Ratio clusters_ratio(const paper::Hierarchy<Real>& hierarchy) {
  Ratio ratio;
  for (const paper::Level<Real>& level : hierarchy.levels) {
    for (std::size_t c = 0; c < level.size(); ++c) {
      const std::size_t first = level.first_vertex[c];
      const std::size_t size = level.first_vertex[c + 1] - first;
      const auto points = std::span<const Real>(hierarchy.positions).subspan(3 * first, 3 * size);
      ratio.add(static_cast<double>(level.spheres[c].radius), smallest_radius(points));
    }
  }
  return ratio;
}

Ratio index_ratio(const MeshView& mesh) {
  const paper::Index index = paper::build(mesh, {.levels = 6, .discard = 1});
  return std::visit([](const auto& hierarchy) { return clusters_ratio(hierarchy); },
                    paper::IndexAccess::hierarchy(index));
}

TEST(SphereCgal, ClustersOfTheFamilies) {
  Ratio all;
  const auto surfaces = surface_families();
  for (const Family& family : surfaces) {
    const Ratio ratio = index_ratio(make_mesh(family, 1, 2000).view());
    EXPECT_LE(ratio.largest, 1.0011) << family.name;
    all.largest = std::max(all.largest, ratio.largest);
    all.spheres += ratio.spheres;
  }
  all.print("clusters of families");
  EXPECT_GT(all.spheres, 1000U);
}

class SphereCgalShared : public testing::TestWithParam<const char*> {};

TEST_P(SphereCgalShared, Clusters) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam());
  const Ratio ratio = index_ratio(mesh.view());
  ratio.print(GetParam());
  EXPECT_LE(ratio.largest, 1.0011);
  EXPECT_GT(ratio.spheres, 0U);
}

INSTANTIATE_TEST_SUITE_P(Meshes, SphereCgalShared,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_victoria0.off", "scan/dragon_res3.ply",
                                         "scan/stanford_bunny.ply", "cad/thingi10k_908460.stl",
                                         "scan/cortex_left_41k.ply.zst"));

}  // namespace
}  // namespace meshhood::test
