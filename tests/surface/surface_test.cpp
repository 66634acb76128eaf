// SPDX-License-Identifier: MIT
// A surface that follows the refits of its index is one that is made anew.
#include "meshhood/surface.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/curvature.h"
#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/patch.h"
#include "meshhood/refit.h"
#include "meshhood/search.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

/// All that a surface tells, as numbers.
std::vector<double> answers(const Surface& surface, std::span<const SpacePoint> points) {
  std::vector<double> all;
  for (const SurfacePoint& hit : surface.closest_points(points)) {
    all.insert(all.end(), {static_cast<double>(hit.face), hit.distance, hit.barycentric[0], hit.point[2]});
  }
  const Curvatures k = curvatures(surface, {.radius = 2.0});
  all.insert(all.end(), k.k1.begin(), k.k1.end());
  const std::vector<double> across = thickness(surface, {}, ThicknessMethod::Sphere);
  for (const double way : across) all.push_back(std::isnan(way) ? -1 : way);
  const auto areas = surface.vertex_areas();
  all.insert(all.end(), areas.begin(), areas.end());
  const Invariants patches = invariants(surface, {.radius = 2.0});
  all.insert(all.end(), patches.area.begin(), patches.area.end());
  for (const double volume : patches.volume) all.push_back(std::isnan(volume) ? -1 : volume);
  for (const SurfacePoint& gap : gaps(surface, {.radius = 2.0})) all.push_back(gap.distance);
  const std::vector<VertexId> ids{0, 1, 2};
  for (const std::size_t face : surface.faces(ids, Corners::Any)) all.push_back(static_cast<double>(face));
  return all;
}

MESHHOOD_SUITE_OF_FAMILIES(SurfaceOf);

TEST_P(SurfaceOf, FollowsRefits) {
  TestMesh mesh = make_mesh(GetParam(), 9, 400);
  bool has_triangles = false;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) has_triangles |= mesh.face(face).size() >= 3;
  if (!has_triangles || mesh.size() < 3) GTEST_SKIP() << "no triangles";
  Index index = build(mesh.view());
  Surface surface(index, mesh.view());
  Random random(1);
  std::vector<SpacePoint> points;
  for (std::size_t i = 0; i < 20; ++i) {
    const std::size_t v = random.below(mesh.size());
    points.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
  }
  EXPECT_EQ(answers(surface, points), answers(Surface(index, mesh.view().faces), points));
  for (std::size_t round = 0; round < 6; ++round) {
    std::vector<VertexId> changed;
    for (std::size_t i = 0; i < 5; ++i) changed.push_back(static_cast<VertexId>(random.below(mesh.size())));
    // To the place of another vertex, so that positions keep their precision; in the last round, out of the frame.
    for (const VertexId v : changed) {
      const std::size_t from = random.below(mesh.size());
      for (std::size_t i = 0; i < 3; ++i) {
        mesh.positions[3 * v + i] = mesh.positions[3 * from + i] * (round == 5 ? 4 : 1);
      }
    }
    if (round % 3 == 0) {
      index.refit_in_place(mesh.positions_view());
    } else {
      index.refit_in_place(mesh.positions_view(), changed);
    }
    expect_refused(ErrorCode::InvalidOption, "refitted in place", [&] { return surface.closest_point({0, 0, 0}); });
    if (round % 3 == 0) {
      surface.refit_in_place(index);
    } else {
      surface.refit_in_place(index, changed);
    }
    ASSERT_EQ(answers(surface, points), answers(Surface(index, mesh.view().faces), points)) << "round " << round;
  }
}

class OneSurface : public testing::Test {
 protected:
  TestMesh mesh = bumpy_grid(12).finish(false);
  Index index = build(mesh.view());
  Surface surface{index, mesh.view()};
  std::vector<SpacePoint> points{{1.2, 3.4, 5}, {7, 2, -1}};
};

TEST_F(OneSurface, OfOtherMasksKeepsItsOwnGeometry) {
  std::vector<std::uint8_t> walls(mesh.size());
  walls[17] = 1;
  const Surface walled = surface.on(masked(index, {.walls = walls}));
  const std::vector<double> before = answers(walled, points);
  EXPECT_NE(before, answers(surface, points)) << "curvature depends on the walls";
  mesh.positions[3 * 17 + 2] += 1;
  const std::vector<VertexId> changed{17};
  const Index moved = refit(index, mesh.positions_view(), changed);
  surface.refit_in_place(moved, changed);
  EXPECT_EQ(answers(surface, points), answers(Surface(moved, mesh.view()), points));
  EXPECT_EQ(answers(walled, points), before);
}

TEST_F(OneSurface, LeavesSearchersOfTheIndexBefore) {
  PatchSearcher searcher(surface);
  const PatchMeasure before = searcher.measure(17, 1.5);
  mesh.positions[3 * 17 + 2] += 1;
  const std::vector<VertexId> changed{17};
  const Index moved = refit(index, mesh.positions_view(), changed);
  surface.refit_in_place(moved, changed);
  EXPECT_NE(PatchSearcher(surface).measure(17, 1.5).area, before.area);
  EXPECT_EQ(searcher.measure(17, 1.5).area, before.area);
}

TEST_F(OneSurface, HasTheAreasOfTheVertices) {
  const auto areas = surface.vertex_areas();
  EXPECT_EQ(std::vector(areas.begin(), areas.end()), vertex_areas(mesh.view()));
}

TEST_F(OneSurface, CountsWhatHasBeenMade) {
  const std::size_t before = surface.bytes();
  EXPECT_EQ(before, 3 * sizeof(VertexId) * surface.face_count());
  static_cast<void>(answers(surface, points));
  EXPECT_GT(surface.bytes(), before + 40 * surface.face_count() + 32 * surface.vertex_count());
}

TEST_F(OneSurface, RefusesIndexesOfOtherMeshes) {
  const Index other = build(mesh.view());
  const std::vector<VertexId> far{0, 500};
  expect_refused(ErrorCode::InvalidOption, "another mesh", [&] { surface.refit_in_place(other); });
  expect_refused(ErrorCode::VertexOutOfRange, "row 1", [&] { surface.refit_in_place(index, far); });
  const std::vector<double> normals(3 * mesh.size(), 1.0);
  Surface given = Surface::of_normals(index, normals, mesh.view().faces);
  expect_refused(ErrorCode::InvalidOption, "normals of its own", [&] { given.refit_in_place(index); });
  EXPECT_EQ(given.closest_point({1, 2, 3}).face, surface.closest_point({1, 2, 3}).face);
}

}  // namespace
}  // namespace meshhood::test
