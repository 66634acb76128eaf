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
#include "meshhood/surface.h"

#include "batch/packets.h"
#include "patch/search.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"
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
  /// Compares the patches around all vertices.
  static void compare(const Index& index, const FacesView& faces, double radius, Tally& tally) {
    const Surface surface(index, faces);
    const PatchState& state = SurfaceAccess::state(surface).patches();
    PacketPatches packets(state);
    PatchSearch search(state);
    const auto visit = [&](const PacketAnswer& answer) {
      const QueryWord found = packets.find(answer, true);
      tally.found += count_of(found);
      tally.left += count_of(answer.queries & ~found);
      for_each_query(found, [&](std::size_t q) {
        const std::uint32_t place = state.index->place(answer.vertices[q]);
        search.run(state.index->position(place), radius, state.triangles.fan(place), true);
        expect_same(state, packets, q, search, radius);
      });
    };
    for_each_packet(index, {.radius = radius}, [&](unsigned) -> PacketVisitor { return visit; }, {}, {.threads = 1});
  }

  static void expect_same(const PatchState& state, const PacketPatches& packets, std::size_t q,
                          const PatchSearch& search, double radius) {
    std::vector<TriangleId> triangles;
    for (TriangleId t = 0; t < state.triangles.size(); ++t) {
      if (packets.has(q, t)) triangles.push_back(t);
    }
    std::ranges::sort(triangles, {}, [&](TriangleId t) { return std::pair(state.triangles.face[t], t); });
    ASSERT_EQ(triangles, search.triangles());
    EXPECT_EQ(packets.exists(q), !triangles.empty());
    const double disc = std::numbers::pi * radius * radius;
    EXPECT_NEAR(packets.area(q) / disc, search.area() / disc, 1e-12 * std::max(1.0, search.area() / disc));
    EXPECT_EQ(std::isnan(packets.volume(q)), std::isnan(search.volume()));
    if (std::isnan(search.volume())) return;
    const double ball = disc * radius * 4 / 3;
    const double error = std::abs(packets.volume(q) - search.volume()) / ball;
    // Whether a sheet without thickness is next to nothing or next to all is rounding.
    EXPECT_LT(std::min(error, std::abs(error - 1)), 1e-12 * std::max(1.0, std::abs(search.volume()) / ball));
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
  for (std::uint64_t seed = 0; seed < scaled(12, 2); ++seed) {
    SCOPED_TRACE(seed);
    const TestMesh mesh = make_mesh(GetParam(), seed, 150);
    if (TestTriangles(mesh).corners.empty()) continue;
    const Index index = build(mesh.view());
    Random random(seed);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), 12);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), 5);
    const double edge = mean_edge_length(index);
    for (const double edges : {0.3, 1.1, 2.7, 6.0, 30.0}) {
      const double radius = edge * edges * random.uniform(0.9, 1.1);
      if (!(radius > 1e-100 && radius < 1e100)) continue;
      SCOPED_TRACE(radius);
      compare(index, mesh.view().faces, radius, plain);
      compare(masked(index, {.ignored = ignored}), mesh.view().faces, radius, walled);
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
  }
  std::printf("found %zu, left %zu; with masks %zu and %zu\n", plain.found, plain.left, walled.found, walled.left);
}

INSTANTIATE_TEST_SUITE_P(Families, PacketPatchesOf, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
