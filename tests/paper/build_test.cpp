// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "paper/same_index.h"
#include "support/families.h"
#include "support/refusal.h"
#include "support/reports.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using paper::BuildOptions;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> level_numbers(const paper::Index& index) {
  std::vector<int> numbers;
  for (const LevelSummary& level : index.levels()) numbers.push_back(level.level);
  return numbers;
}

/// Whether each cluster is a whole component.
bool is_complete(const paper::Index& index) { return index.levels().back().mean_siblings == 0; }

TEST(Build, DefaultIsFiveLevelsOfWhichThreeAreKept) {
  const TestMesh mesh = make_grid(60, 60, false);
  EXPECT_THAT(level_numbers(paper::build(mesh.view())), ElementsAre(2, 3, 4));
}

TEST(Build, OptionsDecideWhichLevelsAreKept) {
  const TestMesh mesh = make_grid(60, 60, true);
  EXPECT_THAT(level_numbers(paper::build(mesh.view(), {.levels = 4, .discard = 0})), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(level_numbers(paper::build(mesh.view(), {.levels = 1, .discard = 0})), ElementsAre(0));
  EXPECT_THAT(level_numbers(paper::build(mesh.view(), {.levels = 3, .discard = 2})), ElementsAre(2));
  EXPECT_THAT(level_numbers(paper::build(mesh.view(), {.levels = 3, .discard = 1000})), ElementsAre(2));
}

TEST(Build, PositionsAreInIndexOrder) {
  const TestMesh mesh = make_grid(60, 60, true);
  const paper::Index index = paper::build(mesh.view());
  const PositionsView of_mesh = mesh.view().positions;
  const auto expect_in_order = [&](const auto& positions) {
    const auto kept = positions.packed();
    of_mesh.visit([&](const auto& strided) {
      const auto xyz = strided.packed();
      ASSERT_EQ(kept.size(), xyz.size());
      for (std::size_t i = 0; i < kept.size(); ++i)
        ASSERT_EQ(kept[i], xyz[std::size_t{3} * index.permutation()[i / 3] + i % 3]);
    });
  };
  index.positions().visit(expect_in_order);
}

TEST(Build, AllLevelsEndWithOneClusterForEachComponent) {
  TestMesh mesh = make_grid(20, 20, false);
  append(mesh, make_grid(3, 3, false));
  mesh.add_vertex(100, 0, 0);
  const paper::Index index = paper::build(mesh.finish(true).view(), {.levels = BuildOptions::kAllLevels, .discard = 0});
  EXPECT_TRUE(is_complete(index));
  EXPECT_EQ(index.levels().back().clusters, 3U);
  EXPECT_LT(index.levels().size(), 10U);
  EXPECT_THAT(index.check(mesh.view()), IsEmpty());
}

TEST(Build, ProgressAscendsAndAnyReportCanCancel) {
  const TestMesh mesh = make_grid(60, 60, false);
  for (const int levels : {1, 5, BuildOptions::kAllLevels}) {
    const auto call = [&](const Progress& progress) {
      static_cast<void>(paper::build(mesh.view(), {.levels = levels}, {.progress = progress}));
    };
    const Reports reports = reports_of(call);
    expect_from_nothing_to_all(reports, 3);
    for (std::size_t last = 0; last < reports.size(); ++last) expect_cancelled_at(last, call);
  }
}

TEST(Build, LevelsShrinkByHalfUntilComplete) {
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 0; seed < scaled(10, 2); ++seed, ++meshes) {
      const TestMesh mesh = make_mesh(family, seed, 20 + 50 * seed);
      const auto index =
          paper::build(mesh.view(), {.levels = BuildOptions::kAllLevels, .discard = 0, .fusion_growth = 0});
      EXPECT_TRUE(is_complete(index)) << mesh.name;
      EXPECT_LE(index.levels().size(), 2 + std::bit_width(mesh.size())) << mesh.name;
      EXPECT_THAT(index.check(mesh.view()), IsEmpty()) << mesh.name;
    }
  }
  std::printf("%zu meshes\n", meshes);
}

TEST(Build, LargerFusionGrowthGivesFewerClusters) {
  const TestMesh mesh = make_grid(60, 60, false);
  const auto clusters = [&](double growth) {
    return paper::build(mesh.view(), {.levels = 2, .discard = 1, .fusion_growth = growth}).levels().back().clusters;
  };
  EXPECT_LE(clusters(4), clusters(0));
  EXPECT_LT(clusters(16), clusters(4));
  EXPECT_EQ(clusters(1e9), 1U);
}

TEST(Build, LevelSummariesAgreeWithTheMesh) {
  const TestMesh mesh = make_grid(50, 40, false);
  const paper::Index index = paper::build(mesh.view(), {.levels = 3, .discard = 0});
  EXPECT_EQ(index.vertex_count(), 2000U);
  const auto levels = index.levels();
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[0].clusters, 2000U);
  EXPECT_EQ(levels[0].mean_vertices, 1.0);
  EXPECT_EQ(levels[0].mean_radius, 0.0);
  const auto edges = static_cast<double>(adjacency(mesh.view()).neighbors.size());
  EXPECT_EQ(levels[0].mean_siblings, edges / 2000);
  std::size_t bytes = 2000 * (3 * sizeof(float) + sizeof(VertexId));
  for (const auto& level : levels) {
    EXPECT_DOUBLE_EQ(level.mean_vertices * static_cast<double>(level.clusters), 2000);
    bytes += level.bytes;
  }
  EXPECT_GT(levels[2].mean_radius, levels[1].mean_radius);
  EXPECT_GT(index.bytes().total(), bytes);  // plus the lowest cluster of each vertex
  EXPECT_LT(index.bytes().total(), bytes + std::size_t{4} * 2000);
}

TEST(Build, IndexOutlivesTheMeshAndCanBeMoved) {
  const TestMesh mesh = make_grid(10, 10, false);
  paper::Index index = [&] {
    const TestMesh copy = mesh;  // NOLINT(performance-unnecessary-copy-initialization): destroyed before the index
    return paper::build(copy.view());
  }();
  const paper::Index moved = std::move(index);
  index = paper::build(mesh.view());
  EXPECT_TRUE(same_index(index, moved));
}

TEST(Build, SameMeshAndOptionsGiveTheSameIndex) {
  std::size_t indexes = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 0; seed < scaled(10, 2); ++seed) {
      const TestMesh mesh = make_mesh(family, seed, 30 + 40 * seed);
      const BuildOptions options{.levels = 1 + static_cast<int>(seed % 5), .discard = static_cast<int>(seed % 3)};
      const paper::Index index = paper::build(mesh.view(), options);
      const Adjacency graph = adjacency(mesh.view());
      EXPECT_TRUE(same_index(index, paper::build(mesh.view(), options))) << mesh.name;
      EXPECT_TRUE(same_index(index, paper::build(GraphView{mesh.positions_view(), graph.view()}, options)))
          << mesh.name;
      EXPECT_THAT(index.check(GraphView{mesh.positions_view(), graph.view()}), IsEmpty()) << mesh.name;
      indexes += 3;
    }
  }
  std::printf("%zu indexes\n", indexes);
}

template <class Index>
std::vector<Index> widened(const TestMesh& mesh) {
  return {mesh.corners.begin(), mesh.corners.end()};
}

TEST(Build, IndexTypeOfTheFacesDoesNotMatter) {
  const TestMesh mesh = make_grid(30, 30, false);
  const auto of = [&](const auto& corners) {
    return paper::build({mesh.positions_view(), FacesView::triangles(corners)}, {.levels = 3, .discard = 0});
  };
  const paper::Index index = of(mesh.corners);
  EXPECT_TRUE(same_index(index, of(widened<std::int32_t>(mesh))));
  EXPECT_TRUE(same_index(index, of(widened<std::uint64_t>(mesh))));
  EXPECT_TRUE(same_index(index, of(widened<std::int64_t>(mesh))));
  EXPECT_TRUE(same_index(index, paper::build(mesh.view(), {.levels = 3, .discard = 0})));
}

TEST(Build, FloatAndDoublePositionsGiveTheSameClusters) {
  const TestMesh single = make_grid(30, 30, false);
  TestMesh wide = single;
  wide.finish(false);
  const paper::Index a = paper::build(single.view());
  const paper::Index b = paper::build(wide.view());
  EXPECT_TRUE(std::ranges::equal(a.permutation(), b.permutation()));
}

// Row A1 of docs/reliability.md.
TEST(Build, OptionsOutOfRangeAreRefused) {
  const TestMesh mesh = make_grid(3, 3, false);
  const auto refuse = [&](const BuildOptions& options, const char* cause) {
    expect_refused(ErrorCode::InvalidOption, cause, [&] { return paper::build(mesh.view(), options); });
  };
  refuse({.levels = 0}, "levels is 0");
  refuse({.levels = -3}, "levels is -3");
  refuse({.discard = -1}, "discard is -1");
  refuse({.fusion_growth = -1}, "fusion_growth is -1");
  refuse({.fusion_growth = std::numeric_limits<double>::infinity()}, "fusion_growth is inf");
  refuse({.fusion_growth = std::numeric_limits<double>::quiet_NaN()}, "fusion_growth is nan");
}

}  // namespace
}  // namespace meshhood::test
