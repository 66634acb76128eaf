// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/sorted.h"

namespace meshhood::inline v0_1::paper {

struct SearcherAccess {
  /// Continues as if there had been `queries` queries.
  static void set_query(Searcher& searcher, std::uint32_t queries) { searcher.scratch_->query = queries; }
};

}  // namespace meshhood::inline v0_1::paper

namespace meshhood::test {
namespace {

/// A path in the shape of a long narrow U: its two arms are near each other in space and far apart along the path.
TestMesh hairpin() {
  TestMesh mesh;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const bool back = i >= 200;
    mesh.add_vertex(back ? 399 - i : i, back ? 0.5 : 0, 0);
    if (i > 0) mesh.add_face({i - 1, i});
  }
  return mesh.finish(true);
}

TEST(Query, ClimbsUpToTheFirstLevelWithALargeEnoughMeanRadius) {
  const TestMesh mesh = make_grid(80, 80, false);
  const paper::Index index = paper::build(mesh.view(), {.levels = 5, .discard = 0});
  const auto levels = index.levels();
  paper::Searcher searcher(index);
  std::vector<VertexId> out;
  for (const double factor : {1.0, 10.0, 50.0}) {
    for (int half = 0; half < 400; ++half) {
      const double radius = half / 2.0;
      searcher.set_options({.radius_ratio = factor});
      searcher.neighborhood(1234, radius, out);
      const auto wanted =
          std::ranges::find_if(levels, [&](const auto& level) { return level.mean_radius >= radius / factor; });
      const int expected = wanted == levels.end() ? levels.back().level : wanted->level;
      ASSERT_EQ(searcher.profile().level, expected) << "radius " << radius << ", factor " << factor;
    }
  }
}

TEST(Query, LargeClustersGiveExtraVerticesAcrossAGap) {
  const TestMesh mesh = hairpin();
  const paper::Index index = paper::build(mesh.view(), {.levels = 6, .discard = 0});
  paper::Searcher searcher(index);
  std::vector<VertexId> coarse;
  std::vector<VertexId> fine;
  searcher.set_options({.radius_ratio = 0.1});
  searcher.neighborhood(150, 10, coarse);
  searcher.set_options({.radius_ratio = 1000});
  searcher.neighborhood(150, 10, fine);
  const auto exact = exact_neighborhood(mesh.view(), 150, 10);
  EXPECT_THAT(sorted(fine), testing::ElementsAreArray(sorted(exact)));
  EXPECT_GT(coarse.size(), exact.size());
}

TEST(Query, ProfileCountsClustersAndTestedVertices) {
  const TestMesh mesh = make_grid(60, 60, false);
  const paper::Index index = paper::build(mesh.view(), {.levels = 3, .discard = 0});
  paper::Searcher searcher(index);
  std::vector<VertexId> out;
  searcher.neighborhood(0, 0, out);
  EXPECT_THAT(out, testing::ElementsAre(0));
  EXPECT_EQ(searcher.profile().level, 0);
  EXPECT_EQ(searcher.profile().clusters_reached, 1U);
  searcher.neighborhood(1830, 15, out);
  EXPECT_GT(searcher.profile().clusters_reached, 10U);
  EXPECT_LT(searcher.profile().vertices_tested, out.size());  // most clusters lie inside
  const std::size_t tested = searcher.profile().vertices_tested;
  EXPECT_EQ(searcher.count(1830, 15), out.size());
  EXPECT_EQ(searcher.profile().vertices_tested, tested);
}

TEST(Query, AnswersDoNotDependOnEarlierQueries) {
  const TestMesh mesh = make_grid(40, 40, false);
  const paper::Index index = paper::build(mesh.view());
  paper::Searcher used(index);
  std::vector<VertexId> out;
  std::vector<VertexId> expected;
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = random.uniform(0, 30);
    used.neighborhood(v, radius, out);
    paper::Searcher(index).neighborhood(v, radius, expected);
    ASSERT_EQ(out, expected) << "vertex " << v << ", radius " << radius;
  }
}

// Row C3 of docs/reliability.md.
TEST(Query, AnswersStayTheSameWhenTheQueryNumberWrapsAround) {
  const TestMesh mesh = make_grid(40, 40, false);
  const paper::Index index = paper::build(mesh.view(), {.discard = 0});
  paper::Searcher searcher(index);
  std::vector<VertexId> expected;
  std::vector<VertexId> out;
  for (int i = 0; i < 10; ++i) searcher.neighborhood(820, 9, expected);
  paper::SearcherAccess::set_query(searcher, std::numeric_limits<std::uint32_t>::max() - 5);
  for (int i = 0; i < 15; ++i) {
    searcher.neighborhood(820, 9, out);
    EXPECT_EQ(out, expected) << "query " << i;
  }
}

TEST(Query, AnswersStayTheSameWhenTheSearcherIsMovedToItself) {
  const TestMesh mesh = make_grid(40, 40, false);
  const paper::Index index = paper::build(mesh.view());
  paper::Searcher searcher(index);
  const std::size_t expected = searcher.count(820, 9);
  paper::Searcher& same = searcher;
  searcher = std::move(same);
  EXPECT_EQ(searcher.count(820, 9), expected);
}

TEST(Query, ResultsReuseTheirBuffer) {
  const TestMesh mesh = make_grid(40, 40, false);
  const paper::Index index = paper::build(mesh.view());
  paper::Searcher searcher(index);
  std::vector<VertexId> out(mesh.size());
  const VertexId* const buffer = out.data();
  for (VertexId v = 0; v < mesh.size(); ++v) searcher.neighborhood(v, 10, out);
  EXPECT_EQ(out.data(), buffer);
}

}  // namespace
}  // namespace meshhood::test
