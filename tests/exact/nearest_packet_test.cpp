// SPDX-License-Identifier: MIT
// The vertices around each vertex of a leaf by connecting radius, against the plain search of the oracle, on every
// instruction set.
#include "exact/joint/nearest_packet.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"

#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

struct Near {
  std::vector<VertexId> ids;
  std::vector<double> radii;
};

/// The first `count`.
Near near(NearestPacket& packet, unsigned lane, double most, std::size_t count = kAnyNumber) {
  Near found;
  const bool is_all = packet.for_each_near(lane, most, [&](VertexId v, double radius) {
    found.ids.push_back(v);
    found.radii.push_back(radius);
    return found.ids.size() < count;
  });
  EXPECT_EQ(is_all, found.ids.size() < count);
  return found;
}

class NearestPacketIn : public testing::TestWithParam<Family> {};

TEST_P(NearestPacketIn, FindsTheConnectedVerticesByConnectingRadius) {
  std::size_t searches = 0;
  for (const std::size_t vertices : {1U, 33U, 400U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    if (mesh.size() == 0) continue;
    const RegionOracle oracle(mesh);
    Random random(vertices);
    for (const std::size_t rarity : {0U, 6U}) {
      PlainStart start;
      start.walls = draw_mask(random, mesh.size(), rarity);
      start.ignored = draw_mask(random, mesh.size(), rarity);
      const Index index = masked(build(mesh.view()), {start.walls, start.ignored});
      const IndexView& view = IndexAccess::view(index);
      for (const Isa isa : available_isas()) {
        NearestPacket packet(view, isa);
        for (std::size_t i = 0; i < scaled(30, 6); ++i, ++searches) {
          const auto v = static_cast<VertexId>(random.below(mesh.size()));
          start.center = position(mesh, v);
          start.seeds = {v};
          const std::vector<double> all = oracle.connecting_radii(start);
          // Also of a vertex, where the ball just holds it.
          const double other = all[random.below(mesh.size())];
          const double gathered = random.below(4) == 0 || other == kInfinity ? kInfinity : other;
          ASSERT_TRUE(packet.gather(leaf_of(view.slot[v]), gathered, kAnyNumber));
          const double most = random.below(2) == 0 ? gathered : std::min(gathered, all[random.below(mesh.size())]);
          const std::vector<double> radii = oracle.connecting_radii(start, most);
          Near expected{oracle.in_order(start, radii), {}};
          for (const VertexId w : expected.ids) expected.radii.push_back(radii[w]);
          const Near found = near(packet, lane_of(view.slot[v]), most);
          ASSERT_EQ(found.ids, expected.ids) << mesh.name << ", vertex " << v << ", radius " << most;
          ASSERT_EQ(found.radii, expected.radii);
          if (expected.ids.size() < 2) continue;
          expected.ids.resize(1 + random.below(expected.ids.size() - 1));
          ASSERT_EQ(near(packet, lane_of(view.slot[v]), most, expected.ids.size()).ids, expected.ids);
        }
      }
    }
  }
  std::printf("%s: %zu searches\n", std::string(GetParam().name).c_str(), searches);
}

INSTANTIATE_TEST_SUITE_P(All, NearestPacketIn, testing::ValuesIn(families()), family_name);

TEST(NearestPacket, StopsAtTheLimitAndKnowsWhatIsWhole) {
  const TestMesh mesh = bumpy_grid(30);
  const Index index = build(mesh.view());
  const IndexView& view = IndexAccess::view(index);
  const auto leaves = static_cast<std::size_t>(
      std::ranges::count_if(view.leaves.first(view.leaf_count()), [](const Leaf& leaf) { return leaf.size != 0; }));
  NearestPacket packet(view, best_isa());
  EXPECT_TRUE(packet.gather(0, 0, leaves / 2));
  EXPECT_FALSE(packet.is_whole());
  EXPECT_TRUE(packet.gather(0, kInfinity, leaves));
  EXPECT_TRUE(packet.is_whole());
  EXPECT_EQ(near(packet, 0, kInfinity).ids.size(), mesh.size());
  EXPECT_FALSE(packet.gather(0, kInfinity, leaves - 1));
  EXPECT_TRUE(packet.gather(0, 0, leaves / 2)) << "it does not remember the last leaves";
  EXPECT_EQ(near(packet, 0, 0).ids.size(), 1U);
}

}  // namespace
}  // namespace meshhood::test
