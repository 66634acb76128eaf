// SPDX-License-Identifier: MIT
// The paths from several vertices at once are those from each of them, bit for bit, on every instruction set.
#include "exact/joint/path_packet.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
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

/// Compares packets with a search for each query.
class PacketTrial {
 public:
  PacketTrial(const TestMesh& mesh, Isa isa, Random& random, const PathLimits& limits)
      : random_(random),
        index_(with_masks(mesh, random)),
        view_(IndexAccess::view(index_)),
        graph_(IndexAccess::share_graph(index_)),
        single_(view_, *graph_),
        packet_(view_, *graph_, isa, limits) {
    if (view_.vertex_count() > 0) single_.run(0, kInfinity);
    for (const Path& path : single_.found()) some_lengths_.push_back(path.length);
  }

  /// Returns whether the queries were answered together.
  bool run() {
    std::vector<PathQuery> queries;
    const auto vertices = static_cast<std::uint32_t>(view_.vertex_count());
    const auto first = static_cast<std::uint32_t>(random_.below(vertices));
    const bool are_near = random_.below(3) != 0;
    const std::size_t count = 1 + random_.below(kPacketCapacity);
    for (std::size_t i = 0; i < count; ++i) {
      const auto step = static_cast<std::uint32_t>(random_.below(are_near ? 32 : vertices));
      queries.push_back({(first + step) % vertices, radius()});
    }
    const bool together = packet_.run(queries);
    if (together) {
      compare(queries);
    } else {
      for (const PathQuery& query : queries) {
        packet_.run_single(query);
        compare({query});
      }
    }
    return together;
  }

 private:
  static Index with_masks(const TestMesh& mesh, Random& random) {
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), random.below(2) * 9);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), random.below(2) * 4);
    return masked(build(mesh.view()), {walls, ignored});
  }

  double radius() {
    switch (random_.below(8)) {
      case 0: return 0;
      case 1: return kInfinity;
      case 2: return some_lengths_[random_.below(some_lengths_.size())];
      default: return *std::ranges::max_element(some_lengths_) * random_.uniform(0, 0.6);
    }
  }

  void compare(const std::vector<PathQuery>& queries) {
    const PerLane<std::uint64_t> counts = packet_.counts();
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const std::vector<Path> expected = paths(queries[i]);
      ASSERT_EQ(counts[i], expected.size());
      const std::span<const Path> found = packet_.paths_in_order(i);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].end, expected[k].end);
        ASSERT_EQ(found[k].length, expected[k].length);
      }
    }
    compare_leaves(queries);
  }

  void compare_leaves(const std::vector<PathQuery>& queries) {
    std::vector<std::map<std::uint32_t, double>> found(queries.size());
    std::uint32_t end = 0;
    for (const auto& [leaves, all, reached] : packet_.pieces()) {
      EXPECT_GE(leaves.begin, end);
      EXPECT_EQ(leaves.end, leaves.begin + 1);
      end = leaves.end;
      packet_.select(leaves.begin);
      QueryWord any = 0;
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
        any |= reached[lane];
        for_each_query(reached[lane], [&, first = view_.leaf_begin[leaves.begin]](std::size_t i) {
          found[i][first + lane] = packet_.at(lane)[i];
        });
      }
      EXPECT_NE(any, 0U);
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
      std::map<std::uint32_t, double> expected;
      for (const Path& path : paths(queries[i])) expected[path.end] = path.length;
      ASSERT_EQ(found[i], expected);
    }
  }

  /// By a search of its own, without ignored vertices.
  std::vector<Path> paths(const PathQuery& query) {
    single_.run(query.vertex, query.radius);
    std::vector<Path> result;
    for (const Path& path : single_.found_in_order()) {
      if (!view_.is_ignored_at(path.end)) result.push_back(path);
    }
    return result;
  }

  Random& random_;
  Index index_;
  const IndexView& view_;
  std::shared_ptr<KeptGraph> graph_;
  PathSearch single_;
  PathPacket packet_;
  std::vector<double> some_lengths_{0};  // vertex 0 may be a wall
};

class PathsOfFamily : public testing::TestWithParam<Family> {};

TEST_P(PathsOfFamily, AreThoseOfSearchesOneByOne) {
  Random random(71);
  std::size_t together = 0;
  std::size_t one_by_one = 0;
  for (std::uint64_t seed = 0; seed < scaled(16, 4); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    if (mesh.size() == 0) continue;
    const Isa isa = available_isas()[seed % available_isas().size()];
    const PathLimits limits = seed % 4 == 3 ? PathLimits{.vertices = 100, .steps = 2} : PathLimits{};
    PacketTrial trial(mesh, isa, random, limits);
    for (int i = 0; i < 10 && !testing::Test::HasFatalFailure(); ++i) ++(trial.run() ? together : one_by_one);
  }
  std::printf("%zu packets, %zu beyond the limits\n", together, one_by_one);
}

INSTANTIATE_TEST_SUITE_P(Families, PathsOfFamily, testing::ValuesIn(families()), family_name);

/// A grid, and the queries of all vertices of its first leaf.
struct GridPacket {
  Index index = build(make_grid(40, 40, false).finish(true).view());
  const IndexView& view = IndexAccess::view(index);

  [[nodiscard]] std::vector<PathQuery> queries(double radius) const {
    std::vector<PathQuery> result;
    for (std::uint32_t lane = 0; lane < view.leaves[0].size; ++lane) result.push_back({lane, radius});
    return result;
  }

  [[nodiscard]] PathPacket packet(const PathLimits& limits) const {
    return {view, *IndexAccess::share_graph(index), best_isa(), limits};
  }
};

TEST(PathPacket, TakesEachVertexAFewTimes) {
  const GridPacket grid;
  PathPacket packet = grid.packet({});
  ASSERT_TRUE(packet.run(grid.queries(kInfinity)));
  EXPECT_GE(packet.steps(), grid.view.vertex_count());
  EXPECT_LE(packet.steps(), 2 * grid.view.vertex_count());
}

TEST(PathPacket, EndsAtItsLimits) {
  const GridPacket grid;
  PathPacket of_steps = grid.packet({.steps = 1});
  EXPECT_FALSE(of_steps.run(grid.queries(kInfinity)));
  EXPECT_EQ(of_steps.steps() / grid.view.vertex_count(), 1U);
  PathPacket of_vertices = grid.packet({.vertices = 1599});
  EXPECT_FALSE(of_vertices.run(grid.queries(kInfinity)));
  EXPECT_EQ(of_vertices.steps(), 0U);
  EXPECT_TRUE(of_vertices.run(grid.queries(10)));
  EXPECT_TRUE(grid.packet({.vertices = 1600}).run(grid.queries(kInfinity)));
}

}  // namespace
}  // namespace meshhood::test
