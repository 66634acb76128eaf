// SPDX-License-Identifier: MIT
// The moments of a packet do not depend on what earlier packets left in the scratch memory.
#include "curvature/packet_moments.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/curvature.h"

#include "batch/packets.h"
#include "curvature/surface.h"
#include "support/exact_answer.h"
#include "support/families.h"

namespace meshhood {

/// Fills the scratch memory with NaN, and numbers of vertices that do not exist.
struct ScratchAccess {
  static void poison(PacketMoments& sums) {
    fill(sums.offsets_);
    fill(sums.facing_.normals);
    fill(sums.facing_.rounded);
    fill(sums.waiting_common_.places);
    fill(sums.waiting_common_.words);
    fill(sums.waiting_some_.places);
    fill(sums.waiting_some_.words);
    fill(sums.points_);
    fill(sums.common_);
    fill(sums.some_);
    fill(sums.moments_);
    fill(sums.sizes_);
  }

 private:
  template <class T>
  static void fill(T& scratch) {
    std::memset(static_cast<void*>(&scratch), 0xFF, sizeof(T));  // a NaN in double and in single precision
  }
};

namespace test {
namespace {

const QueryMoments& sum(PacketMoments& sums, const IndexView& index, const PacketAnswer& packet) {
  std::vector<std::uint32_t> places;
  for (const VertexId v : packet.vertices) places.push_back(place_of(index, v));
  sums.begin(places, *std::max_element(packet.radii.begin(), packet.radii.end()));
  for (const CoreLeaves& core : packet.cores) {
    for (const LeafRun& run : core.runs) sums.add(run.vertices.begin, run.vertices.size(), core.queries);
  }
  for (const WholeLeaves& whole : packet.whole) {
    sums.add(whole.run.vertices.begin, whole.run.vertices.size(), whole.queries);
  }
  for (const PartialLeaf& leaf : packet.partial) sums.add(leaf.vertices.begin, leaf.vertices.size(), leaf.queries);
  return sums.finish();
}

TEST(PacketMoments, DoNotDependOnTheScratchMemory) {
  const TestMesh mesh = bumpy_grid(30).finish(false);
  const CurvatureIndex surface = CurvatureIndex::build(build(mesh.view()), mesh.view());
  const SurfaceState& state = CurvatureAccess::state(surface);
  std::vector<double> radii(mesh.size());
  // Stretches of one radius, so that many vertices count for all rows of a packet, and stretches of several.
  for (std::size_t v = 0; v < radii.size(); ++v) {
    radii[v] = v < radii.size() / 2 ? 8.0 : std::array{3.0, 0.5, 1e-320, 8.0}[v % 4];
  }
  std::size_t rows = 0;
  for (const bool filtered : {false, true}) {
    const MomentSource source{.index = &*state.index, .filter = filtered ? &state : nullptr};
    for (const Isa isa : available_isas()) {
      PacketMoments reused(source, isa);
      for_each_packet(state.searched, {.radius = radii}, [&](unsigned) -> PacketVisitor {
        return [&](const PacketAnswer& packet) {
          PacketMoments fresh(source, isa);
          const QueryMoments& expected = sum(fresh, *state.index, packet);
          ScratchAccess::poison(reused);
          const QueryMoments& found = sum(reused, *state.index, packet);
          for (std::size_t q = 0; q < packet.rows.size(); ++q) {
            for (std::size_t m = 0; m < kMomentCount; ++m) ASSERT_EQ(found.at[m][q], expected.at[m][q]);
            ASSERT_EQ(reused.is_accurate(q), fresh.is_accurate(q));
            ++rows;
          }
        };
      });
    }
  }
  std::printf("%zu rows\n", rows);
}

}  // namespace
}  // namespace test
}  // namespace meshhood
