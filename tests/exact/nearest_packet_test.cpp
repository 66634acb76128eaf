// SPDX-License-Identifier: MIT
// How far the vertices around a leaf are gathered. Which they are, and in which order: batch/k_nearest_test.cpp.
#include "exact/joint/nearest_packet.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "support/families.h"
#include "support/indexed.h"

namespace meshhood::test {
namespace {

/// The number of vertices within `most` of a vertex of the packet.
std::size_t near(NearestPacket& packet, unsigned lane, double most) {
  std::size_t count = 0;
  EXPECT_TRUE(packet.for_each_near(lane, most, [&](VertexId, double) { return ++count > 0; }));
  return count;
}

TEST(NearestPacket, StopsAtTheLimitAndKnowsWhatIsWhole) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const IndexView& view = IndexAccess::view(index);
  const auto leaves = static_cast<std::size_t>(
      std::ranges::count_if(view.leaves.first(view.leaf_count()), [](const Leaf& leaf) { return leaf.size != 0; }));
  NearestPacket packet(view, best_isa());
  EXPECT_TRUE(packet.gather(0, 0, leaves / 2));
  EXPECT_FALSE(packet.is_whole());
  EXPECT_TRUE(packet.gather(0, kInfinity, leaves));
  EXPECT_TRUE(packet.is_whole());
  EXPECT_EQ(near(packet, 0, kInfinity), mesh.size());
  EXPECT_FALSE(packet.gather(0, kInfinity, leaves - 1));
  EXPECT_TRUE(packet.gather(0, 0, leaves / 2)) << "it does not remember the last leaves";
  EXPECT_EQ(near(packet, 0, 0), 1U);
}

}  // namespace
}  // namespace meshhood::test
