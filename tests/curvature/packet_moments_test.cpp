// SPDX-License-Identifier: MIT
// The moments of a packet do not depend on what earlier packets left in the scratch memory.
#include "curvature/packet_moments.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/curvature.h"

#include "batch/packets.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// Fills the scratch memory with NaN.
struct ScratchAccess {
  static void poison(PacketMoments& sums) {
    fill(sums.offsets_);
    fill(sums.facing_.normals);
    fill(sums.terms_);
    fill(sums.words_);
    fill(sums.points_.x);
    fill(sums.points_.y);
    fill(sums.points_.z);
    if (!sums.source_.weights.empty()) fill(sums.points_.weight);
    fill(sums.sums_);
    fill(sums.moments_);
    fill(sums.before_.second);
    fill(sums.before_.fourth);
    fill(sums.after_.second);
    fill(sums.after_.fourth);
  }

 private:
  template <class T>
  static void fill(T& scratch) {
    std::memset(static_cast<void*>(&scratch), 0xFF, sizeof(T));  // a NaN in double and in single precision
  }
};

}  // namespace meshhood::inline v0_1

namespace meshhood::test {
namespace {

/// The moments of those queries that have the same unit as the first of them, and which these are.
std::pair<QueryWord, const QueryMoments*> sum(PacketMoments& sums, const IndexView& index, const PacketAnswer& packet,
                                              QueryWord queries) {
  std::vector<std::uint32_t> places;
  for (const VertexId v : packet.vertices) places.push_back(index.place(v));
  const LeafId leaf = leaf_of(index.slot[packet.vertices.front()]);
  const QueryWord some = sums.begin(leaf, places, packet.radii, queries, packet.queries);
  for (const Piece& piece : packet.pieces) sums.add(piece);
  return {some, &sums.finish()};
}

TEST(PacketMoments, DoNotDependOnTheScratchMemory) {
  const TestMesh mesh = bumpy_grid(30).finish(false);
  const Surface surface(build(mesh.view()), mesh.view());
  const OrientedIndex state = SurfaceAccess::oriented(surface);
  std::vector<double> radii(mesh.size());
  // Stretches of one radius, so that many vertices count for all rows of a packet, and stretches of several.
  for (std::size_t v = 0; v < radii.size(); ++v) {
    radii[v] = v < radii.size() / 2 ? 8.0 : std::array{3.0, 0.5, 1e-320, 8.0}[v % 4];
  }
  std::size_t rows = 0;
  std::vector<double> weights(mesh.size());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 + static_cast<double>(i % 7);
  const MomentSource plain{.index = &*state.index};
  const MomentSource filtered{.index = &*state.index, .filter = &state};
  const MomentSource weighted{.index = &*state.index, .weights = weights};
  for (const MomentSource& source : {plain, filtered, weighted}) {
    for (const Isa isa : available_isas()) {
      PacketMoments reused(source, isa);
      const auto make_visitor = [&](unsigned) -> PacketVisitor {
        return [&](const PacketAnswer& packet) {
          for (QueryWord left = first_lanes(static_cast<unsigned>(packet.rows.size())); left != 0;) {
            PacketMoments fresh(source, isa);
            const auto [queries, expected] = sum(fresh, *state.index, packet, left);
            ScratchAccess::poison(reused);
            const auto [same_queries, found] = sum(reused, *state.index, packet, left);
            ASSERT_EQ(queries, same_queries);
            ASSERT_NE(queries & left, 0U);
            for_each_query(queries, [&, &expects = *expected, &finds = *found](std::size_t q) {
              for (std::size_t m = 0; m < kMomentCount; ++m) ASSERT_EQ(finds.at[m][q], expects.at[m][q]);
              ASSERT_EQ(reused.is_accurate(q), fresh.is_accurate(q));
              ++rows;
            });
            left &= ~queries;
          }
        };
      };
      for_each_packet(*state.searched, {.radius = radii}, make_visitor, {.threads = 1});
    }
  }
  std::printf("%zu rows\n", rows);
}

}  // namespace
}  // namespace meshhood::test
