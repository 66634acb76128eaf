// SPDX-License-Identifier: MIT
// Patches from neighborhoods are those of a search over triangles, with walls, ignored vertices and polygons, too.
#include "patch/packet_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/masks.h"
#include "meshhood/patch.h"
#include "meshhood/surface.h"

#include "batch/packets.h"
#include "patch/search.h"
#include "shared/parallel.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/round_meshes.h"
#include "support/scale.h"
#include "support/test_triangles.h"
#include "surface/surface.h"

namespace meshhood::test {
namespace {

/// The queries that packets have answered, and those that they have not.
struct Tally {
  std::size_t found = 0;
  std::size_t left = 0;
};

class PacketPatchesOf : public testing::TestWithParam<Family> {
 protected:
  /// Compares the patches around all vertices, some of a smaller radius.
  void compare(const Index& index, const FacesView& faces, double radius, Tally& tally) const {
    std::vector<double> radii(index.vertex_count(), radius);
    for (std::size_t v = 0; v < radii.size(); v += 7) radii[v] = radius / 2;
    const Surface surface(index, faces);
    TaskContext task(3);
    const PatchState& state = SurfaceAccess::state(surface).patches(task);
    PacketPatches packets(state);
    PatchSearch search(state);
    const auto visit = [&](const PacketAnswer& answer) {
      const QueryWord found = packets.find(answer, true);
      tally.found += count_of(found);
      tally.left += count_of(answer.queries & ~found);
      for_each_query(found, [&](std::size_t q) {
        const std::uint32_t place = state.index->place(answer.vertices[q]);
        search.run(state.index->position(place), answer.radii[q], state.triangles.fans[place], true);
        expect_same(state, packets, q, search);
      });
    };
    for_each_packet(state.searched, {.radius = radii}, [&](unsigned) -> PacketVisitor { return visit; },
                    {.threads = 1});
  }

  static void expect_same(const PatchState& state, PacketPatches& packets, std::size_t q, const PatchSearch& search) {
    std::vector<TriangleId> triangles;
    for (TriangleId t = 0; t < state.triangles.size(); ++t) {
      if (packets.has(q, t)) triangles.push_back(t);
    }
    std::ranges::sort(triangles, {}, [&](TriangleId t) { return std::pair(state.triangles.face[t], t); });
    ASSERT_EQ(triangles, search.triangles());
    for (MeshletId meshlet = 0; meshlet < state.meshlets.size(); ++meshlet) {
      if ((packets.having_all(meshlet) >> q & 1U) == 0) continue;
      for (const TriangleId t : state.triangles.of_meshlet(meshlet)) EXPECT_TRUE(packets.has(q, t));
    }
    EXPECT_EQ(packets.exists(q), !triangles.empty());
    EXPECT_EQ(search.exists(), !triangles.empty());
    const SurfacePoint alone = search.gap();
    EXPECT_EQ(packets.gap(q).face, alone.face);
    EXPECT_EQ(packets.gap(q).corners, alone.corners);
    EXPECT_EQ(packets.gap(q).distance, alone.distance);
    const double r = std::min(packets.ball(q).radius, 4.0);  // the frame holds the mesh, also in an infinite ball
    const double disc = std::numbers::pi * r * r / state.index->frame.scale / state.index->frame.scale;
    EXPECT_NEAR(packets.area(q) / disc, search.area() / disc, 1e-12 * std::max(1.0, search.area() / disc));
    EXPECT_EQ(std::isnan(packets.volume(q)), std::isnan(search.volume()));
    EXPECT_EQ(std::isinf(packets.volume(q)), std::isinf(search.volume()));
    if (!std::isfinite(search.volume())) return;
    const double ball = 4 * std::numbers::pi / 3 * r * r * r;
    if (GetParam().name == "collinear") return;  // what its needles enclose is rounding
    EXPECT_NEAR(packets.volume(q) / ball, search.volume() / ball, 1e-12 * std::max(1.0, search.volume() / ball));
  }

  static std::vector<std::uint8_t> draw_mask(Random& random, std::size_t size, std::size_t one_of) {
    std::vector<std::uint8_t> mask(size);
    for (std::uint8_t& set : mask) set = static_cast<std::uint8_t>(random.below(one_of) == 0);
    return mask;
  }
};

TEST_P(PacketPatchesOf, AreThoseOfASearch) {
  Tally plain;
  Tally walled;
  Tally ignoring;
  for (std::uint64_t seed = 0; seed < scaled(12, 2); ++seed) {
    SCOPED_TRACE(seed);
    const TestMesh mesh = make_mesh(GetParam(), seed, 150);
    if (TestTriangles(mesh).corners.empty()) continue;
    const Index index = build(mesh.view());
    Random random(seed);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), 12);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), 5);
    const double edge = mean_edge_length(index);
    for (const double edges : {0.3, 1.1, 2.7, 6.0, 30.0, kInfinity}) {
      const double unit = edge * random.uniform(0.9, 1.1);
      if (!(unit > 1e-99 && unit < 1e98)) continue;
      const double radius = edges * unit;
      SCOPED_TRACE(radius);
      compare(index, mesh.view().faces, radius, plain);
      compare(masked(index, {.ignored = ignored}), mesh.view().faces, radius, ignoring);
      const Index with_walls = masked(index, {.walls = walls});
      if (std::ranges::find(walls, 0) == walls.end()) continue;
      try {
        compare(with_walls, mesh.view().faces, radius, walled);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidMesh) << error.what();  // no face without a wall
      }
      if (HasFailure()) return;
    }
  }
  const std::span<const Family> surfaces = surface_families();
  const bool is_surface = std::ranges::find(surfaces, GetParam().name, &Family::name) != surfaces.end();
  if (is_surface) {
    EXPECT_GT(plain.found, 10 * plain.left);
    EXPECT_GT(walled.found, plain.found / 4);
  }
  EXPECT_EQ(ignoring.found, plain.found);
  std::printf("found %zu, left %zu; with walls %zu and %zu\n", plain.found, plain.left, walled.found, walled.left);
}

/// A strip of needles across the ball around its first vertex, whose sides dip into it one after the other.
TestMesh make_needles(std::size_t count) {
  TestMesh mesh;
  for (std::size_t i = 0; i < count + 2; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(count);
    mesh.add_vertex(x, i == 0 ? 0 : i % 2 == 0 ? -2 : 2, 0);
  }
  for (std::uint32_t i = 0; i < count; ++i) mesh.add_face(std::vector<std::uint32_t>{i, i + 1, i + 2});
  return mesh.finish(false);
}

TEST(PacketPatches, FollowSidesThatDipIntoTheBall) {
  for (const std::size_t count : {20UL, 60UL, 2000UL}) {
    const auto [mesh, index, surface] = with_surface(make_needles(count));
    TaskContext alone;
    const PatchState& state = SurfaceAccess::state(surface).patches(alone);
    PacketPatches packets(state);
    const std::vector<VertexId> first{0};
    QueryWord found = 0;
    std::size_t triangles = 0;
    const auto visit = [&](const PacketAnswer& answer) {
      found = packets.find(answer, false);
      for (TriangleId t = 0; t < state.triangles.size(); ++t) triangles += packets.has(0, t) ? 1 : 0;
    };
    for_each_packet(index, {.vertices = first, .radius = 0.9}, [&](unsigned) -> PacketVisitor { return visit; },
                    {.threads = 1});
    // Beyond so many the patch is searched alone, so that the time is in proportion.
    EXPECT_EQ(found, count > 64 ? 0U : 1U) << count;
    EXPECT_TRUE(found == 0 || triangles == PatchSearcher(surface).patch(0, 0.9).size());
  }
}

/// Those of a search alone keep their digits beside a far corner, even one of their meshlet.
TEST(PacketPatches, KeepTheirDigitsBesideAFarCorner) {
  constexpr double kRadius = 0.8;
  const double whole = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
  for (const double far : {1e9, 1e16, 1e60}) {
    SCOPED_TRACE(far);
    TestMesh given = ball(7, 10);
    const std::size_t last = given.size() - 1;
    for (std::size_t axis = 0; axis < 3; ++axis) given.positions[3 * last + axis] *= far;
    const auto [mesh, index, surface] = with_surface(std::move(given));
    const Invariants all = invariants(surface, {.radius = kRadius});
    PatchSearcher searcher(surface);
    for (VertexId v = 0; v < last; ++v) {
      EXPECT_NEAR(all.volume[v] / whole, searcher.measure(v, kRadius).volume / whole, 1e-12) << v;
    }
  }
}

/// A wall has no patch, whatever the other rows.
TEST(PacketPatches, OfWallsAreEmpty) {
  const auto [mesh, index] = indexed(make_grid(20, 20, false));
  const std::vector<VertexId> ids{5, 44, 230};
  std::vector<std::uint8_t> walls(mesh.size());
  for (const VertexId v : ids) walls[v] = 1;
  const Index masks = masked(index, {.walls = walls});
  const Surface surface(masks, mesh.view().faces);
  const Invariants all = invariants(surface, {.radius = 2.5});
  const std::vector<SurfacePoint> nearest = gaps(surface, {.radius = 2.5});
  for (const VertexId v : ids) {
    EXPECT_EQ(all.area[v], 0);
    EXPECT_TRUE(std::isnan(all.volume[v]));
    EXPECT_EQ(nearest[v].face, kNoFace);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, PacketPatchesOf, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
