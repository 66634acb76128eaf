// SPDX-License-Identifier: MIT
// Paths of the exact search that ordinary meshes rarely take. Each test forces one and shows that it was taken.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/start.h"

#include "support/exact_answer.h"
#include "support/families.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// Two grids, one above the other, without an edge between them.
TestMesh plates(std::size_t side, double gap) {
  TestMesh mesh = make_grid(side, side, false);
  TestMesh upper = make_grid(side, side, false);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] = gap;
  append(mesh, upper);
  return mesh;
}

TestMesh star(std::size_t vertices) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  for (std::size_t i = 1; i < vertices; ++i) {
    const auto angle = static_cast<double>(i);
    const auto tip = mesh.add_vertex(std::cos(angle) * std::sqrt(angle), std::sin(angle) * std::sqrt(angle), 0);
    mesh.add_face({0, tip});
  }
  return mesh.finish(true);
}

TestMesh points_at_random(std::size_t vertices) {
  Random random(3);
  TestMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
  return mesh.finish(true);
}

void query_everywhere(ExactAnswer& exact, std::size_t vertices, std::initializer_list<double> radii) {
  const std::size_t step = std::max<std::size_t>(1, vertices / scaled(300, 30));
  for (std::size_t v = 0; v < vertices; v += step) {
    for (const double radius : radii) exact.query(static_cast<VertexId>(v), radius);
  }
  ASSERT_EQ(exact.mismatches(), 0U);
  std::printf("%zu queries, 0 mismatches\n", exact.queries());
}

using Way = SearcherAccess::State::Way;

bool last_was_outward(ExactAnswer& exact) {
  return std::any_of(exact.searchers().begin(), exact.searchers().end(),
                     [](Searcher& searcher) { return SearcherAccess::state(searcher).way == Way::Component; });
}

/// The level of the tree that a group belongs to.
std::size_t level_of(std::uint32_t group, const IndexView& index) {
  std::size_t level = 0;
  while (group >= index.tree[level].first_group + index.tree[level].groups) ++level;
  return level;
}

TEST(Rare, BallOnOneSheetIsSearchedOutward) {
  const TestMesh mesh = make_grid(120, 120, false);
  ExactAnswer exact(mesh.view());
  for (Searcher& searcher : exact.searchers()) {
    EXPECT_GT(searcher.count(60 * 120 + 60, 30), 2000U);
    EXPECT_EQ(SearcherAccess::state(searcher).way, Way::Component);
  }
  query_everywhere(exact, mesh.size(), {9, 10, 20, 30, 50, 1000});
}

TEST(Rare, SheetOfAnotherComponentIsLeftOut) {
  const TestMesh mesh = plates(60, 0.6);
  ExactAnswer exact(mesh.view());
  exact.query(30 * 60 + 30, 15);
  EXPECT_TRUE(last_was_outward(exact)) << "the outward search does not enter it";
  EXPECT_LE(*std::max_element(exact.answer().begin(), exact.answer().end()), 3599U);
  query_everywhere(exact, mesh.size(), {0.3, 0.6, 1, 2, 5, 10, 20, 40, 100});
}

TEST(Rare, SingleVerticesAreCutOffAtARoughBoundary) {
  // The edges of such a vertex into the next leaf lead out of the ball, while other vertices of its leaf have nearer
  // neighbors in that leaf.
  TestMesh mesh = make_grid(100, 100, false);
  Random random(7);
  for (double& coordinate : mesh.positions) coordinate += random.uniform(-0.4, 0.4);
  ExactAnswer exact(mesh.finish(true).view());
  for (VertexId v = 0; v < mesh.size(); ++v) {
    for (const double radius : {7.0, 9.0, 12.0}) exact.query(v, radius);
  }
  EXPECT_EQ(exact.mismatches(), 0U);
  std::printf("%zu queries\n", exact.queries());
}

/// A grid, separate patches of surface above it, and tongues: strips above it that are joined to it at one end.
TestMesh grid_below(std::size_t patches, std::size_t tongues) {
  constexpr std::uint32_t kSide = 100;
  constexpr std::size_t kPatch = 9;
  constexpr std::uint32_t kTongue = 24;
  Random random(17);
  TestMesh mesh = make_grid(kSide, kSide, false);
  const auto hang = [&](std::size_t regions, std::size_t rows) {
    TestMesh piece = make_grid(regions, rows, false);
    const auto x = static_cast<double>(random.below(kSide - regions));
    const auto y = static_cast<double>(random.below(kSide - rows));
    const std::array<double, 3> shift{x, y, 0.7};
    for (std::size_t i = 0; i < piece.positions.size(); ++i) piece.positions[i] += shift[i % 3];
    const auto first = static_cast<std::uint32_t>(mesh.size());
    append(mesh, piece);
    return std::pair(first, static_cast<std::uint32_t>(x) + kSide * static_cast<std::uint32_t>(y));
  };
  for (std::size_t i = 0; i < patches; ++i) hang(kPatch, kPatch);
  for (std::size_t i = 0; i < tongues; ++i) {
    const auto [first, below] = hang(kTongue, 5);
    for (std::uint32_t row = 0; row < 5; ++row) mesh.add_face({first + row * kTongue, below + row * kSide});
  }
  return mesh;
}

TEST(Rare, PatchesOfOtherComponentsAreSubtracted) {
  const TestMesh mesh = grid_below(9, 0);
  ExactAnswer exact(mesh.view());
  exact.query(50 * 100 + 50, 45);
  EXPECT_TRUE(last_was_outward(exact));
  EXPECT_LT(*std::max_element(exact.answer().begin(), exact.answer().end()), 100 * 100U);
  query_everywhere(exact, mesh.size(), {1, 5, 8, 12, 20, 33, 45, 60});
}

TEST(Rare, PatchesOfOtherComponentsWhoseNearestVerticesTie) {
  // Every vertex of the grid has two nearest vertices in a patch, often in two leaves. Each counts as a minimum:
  // equally near is not nearer.
  TestMesh mesh = grid_below(9, 0);
  for (std::size_t i = std::size_t{3} * 100 * 100; i < mesh.positions.size(); i += 3) mesh.positions[i] += 0.5;
  ExactAnswer exact(mesh.finish(true).view());
  for (VertexId v = 0; v < mesh.size(); ++v) {
    for (const double radius : {12.0, 20.0}) exact.query(v, radius);
  }
  EXPECT_EQ(exact.mismatches(), 0U);
  std::printf("%zu queries\n", exact.queries());
}

TEST(Rare, VerticesOfOtherComponentsAreRemovedFromLeaves) {
  // A vertex without edges shares a leaf with the surface around it.
  TestMesh mesh = make_grid(100, 100, false);
  Random random(23);
  for (int i = 0; i < 12; ++i) mesh.add_vertex(random.uniform(20, 80), random.uniform(20, 80), 0.3);
  ExactAnswer exact(mesh.finish(true).view());
  exact.query(50 * 100 + 50, 45);
  EXPECT_TRUE(last_was_outward(exact));
  EXPECT_LT(*std::max_element(exact.answer().begin(), exact.answer().end()), 100 * 100U);
  query_everywhere(exact, mesh.size(), {1, 5, 12, 20, 33, 45, 60, 200});
}

TEST(Rare, TonguesBelongToTheAnswerWhereTheirRootIsInTheBall) {
  const TestMesh mesh = grid_below(2, 3);
  ExactAnswer exact(mesh.view());
  exact.query(50 * 100 + 50, 80);
  EXPECT_TRUE(last_was_outward(exact));
  EXPECT_EQ(exact.answer().size(), mesh.size() - 2 * 81);
  query_everywhere(exact, mesh.size(), {1, 5, 8, 10, 12, 15, 18, 20, 25, 33, 45});
}

TEST(Rare, SheetsThatMeetAtOneSideAreConnectedOnlyInALargeBall) {
  TestMesh mesh = plates(40, 0.7);
  for (std::uint32_t i = 0; i < 40; ++i) mesh.add_face({i, 1600 + i});  // joined along one side
  ExactAnswer exact(mesh.view());
  query_everywhere(exact, mesh.size(), {1, 3, 7, 12, 15, 18, 25, 39, 41, 60});
}

/// An accordion of walls, half a unit apart.
TestMesh accordion(std::uint32_t walls, std::uint32_t side) {
  TestMesh mesh = make_grid(std::size_t{walls} * side, side, false);
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const std::uint32_t row = v / side % side;
    const std::uint32_t wall = v / side / side;
    mesh.positions[3 * v + 1] = wall % 2 == 0 ? row : side - 1 - row;
    mesh.positions[3 * v + 2] = 0.5 * wall;
  }
  return mesh.finish(true);
}

/// The vertex in the middle of the wall in the middle.
VertexId middle_of_accordion(std::uint32_t walls, std::uint32_t side) {
  return walls / 2 * side * side + side / 2 * side + side / 2;
}

TEST(Rare, BallThroughManyFoldsIsSearchedAgainFromSmallNodes) {
  const TestMesh mesh = accordion(30, 70);
  ExactAnswer exact(mesh.view());
  for (Searcher& searcher : exact.searchers()) {
    static_cast<void>(searcher.count(middle_of_accordion(30, 70), 42));
    const SearcherAccess::State& state = SearcherAccess::state(searcher);
    ASSERT_EQ(state.way, Way::Component);
    EXPECT_EQ(level_of(state.reach.top_groups()[0], *state.index), 1U);
  }
  query_everywhere(exact, mesh.size(), {3, 8, 16, 30, 34, 42, kInfinity});
}

TEST(Rare, BallThroughManySmallFoldsIsSearchedLeafByLeaf) {
  const TestMesh mesh = accordion(60, 24);
  ExactAnswer exact(mesh.view());
  for (Searcher& searcher : exact.searchers()) {
    static_cast<void>(searcher.count(middle_of_accordion(60, 24), 21));
    EXPECT_EQ(SearcherAccess::state(searcher).way, Way::LeafBfs);
  }
  query_everywhere(exact, mesh.size(), {0.5, 1, 3, 8, 11, 16, 30, kInfinity});
}

// The ball does not reach the folds, but leaves at its surface do: all walls are reached, and all but one are open.
TEST(Rare, AnswerThatIsSmallBesideWhatWasReachedIsSearchedLeafByLeaf) {
  const TestMesh mesh = accordion(40, 80);
  ExactAnswer exact(mesh.view());
  for (Searcher& searcher : exact.searchers()) {
    static_cast<void>(searcher.count(middle_of_accordion(40, 80), 38.5));
    const SearcherAccess::State& state = SearcherAccess::state(searcher);
    EXPECT_EQ(state.way, Way::LeafBfs);
    EXPECT_GT(state.reach.surface_leaves().size(), 100U);
  }
  query_everywhere(exact, mesh.size(), {37, 38.5, 39.5, 41});
}

TEST(Rare, LeavesWithMoreThanEightLinks) {
  const TestMesh mesh = star(20'000);
  ExactAnswer exact(mesh.view());
  const IndexView& index = exact.storage();
  std::size_t most = 0;
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    most = std::max<std::size_t>(most, index.leaves[leaf + 1].first_link - index.leaves[leaf].first_link);
  }
  EXPECT_GT(most, 100U);
  query_everywhere(exact, mesh.size(), {0.5, 1, 5, 40, 100, 150, 300});
}

TEST(Rare, LeavesOfManyComponents) {
  // A hundred thousand components: a leaf holds many, and must not count as connected.
  const TestMesh mesh = points_at_random(scaled(100'000, 1000));
  ExactAnswer exact(mesh.view());
  const IndexView& index = exact.storage();
  const auto last = index.leaves.begin() + static_cast<std::ptrdiff_t>(index.leaf_count());
  const auto disconnected = std::count_if(index.leaves.begin(), last, [](const Leaf& leaf) { return !leaf.connected; });
  EXPECT_GT(disconnected, 30);
  EXPECT_LT(index.leaf_count(), mesh.size() / 25);
  query_everywhere(exact, mesh.size(), {0, 0.01, 0.2, kInfinity});
}

TEST(Rare, SurfacesOfManyComponents) {
  // A hundred thousand small sheets of more than 16 vertices: each has a leaf of its own, in a root group.
  constexpr std::size_t kSheet = 18;
  const std::size_t sheets = scaled(100'000, 1000);
  Random random(11);
  TestMesh mesh;
  for (std::size_t i = 0; i < sheets; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.size());
    const std::array<double, 3> corner{random.uniform(0, 300), random.uniform(0, 300), random.uniform(0, 300)};
    for (std::size_t k = 0; k < kSheet; ++k) {
      const std::size_t row = k / 6;
      mesh.add_vertex(corner[0] + static_cast<double>(k % 6), corner[1] + static_cast<double>(row), corner[2]);
    }
    for (std::uint32_t k = 0; k + 7 < kSheet; ++k) {
      if (k % 6 < 5) mesh.add_face({first + k, first + k + 1, first + k + 7, first + k + 6});
    }
  }
  mesh.finish(true);
  ExactAnswer exact(mesh.view());
  const IndexView& index = exact.storage();
  EXPECT_GT(std::count(index.parents.begin(), index.parents.end(), kNoNode), static_cast<std::ptrdiff_t>(sheets / 16));
  EXPECT_TRUE(exact.index().check(mesh.view()).empty());
  query_everywhere(exact, mesh.size(), {0.5, 1, 3, 6, 40, kInfinity});
  for (std::uint32_t i = 0; i < 100; ++i) {
    const SpacePoint p{random.uniform(-50, 350), random.uniform(0, 300), random.uniform(0, 300)};
    const NearestVertex found = nearest(exact.index(), p);
    double least = kInfinity;
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      least = std::min(least, squared_distance(point(std::span<const double>(mesh.positions), v), {p[0], p[1], p[2]}));
    }
    ASSERT_EQ(found.distance, std::sqrt(least));
  }
}

TEST(Rare, DistancesThatSinglePrecisionCannotDecide) {
  // All distances from the center differ from the radius by a few units in the last place of a float.
  Random random(5);
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  for (std::uint32_t i = 1; i < 3000; ++i) {
    const double height = random.uniform(-1, 1);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double around_axis = std::sqrt(1 - height * height);
    mesh.add_vertex(around_axis * std::cos(angle), around_axis * std::sin(angle), height);
    mesh.add_face({0, i});
  }
  mesh.finish(true);
  ExactAnswer exact(mesh.view());
  for (std::uint32_t i = 1; i < 3000; i += 3) {
    for (const double radius : around(distance(mesh.view().positions, 0, i))) exact.query(0, radius);
  }
  EXPECT_EQ(exact.mismatches(), 0U);
  std::printf("%zu queries\n", exact.queries());
}

TEST(Rare, QueryNumbersRunOut) {
  const TestMesh mesh = plates(40, 0.6);
  ExactAnswer exact(mesh.view());
  for (Searcher& searcher : exact.searchers()) {
    // After a query, whose states would be known again.
    static_cast<void>(searcher.count(20 * 40 + 20, 30));
    ASSERT_EQ(SearcherAccess::state(searcher).way, Way::Component);
    SearcherAccess::state(searcher).reach.states().set_epoch(std::numeric_limits<std::uint32_t>::max() - 5);
  }
  query_everywhere(exact, mesh.size(), {1, 4, 9, 20, 30});
}

TEST(Rare, UnitsFromTheSmallestToTheLargest) {
  for (const int exponent : {-1060, -1000, -520, -300, -100, -70, 0, 70, 120, 300, 490}) {
    TestMesh mesh = make_grid(30, 30, false);
    for (double& x : mesh.positions) x = std::ldexp(x, exponent);
    mesh.finish(false);
    if (exponent > -120 && exponent < 120) {
      TestMesh single = mesh;
      ExactAnswer in_float(single.finish(true).view());
      for (const double radius : {0.5, 1.0, 3.0, 10.0, 50.0}) in_float.query(435, std::ldexp(radius, exponent));
      EXPECT_EQ(in_float.mismatches(), 0U) << exponent;
    }
    ExactAnswer exact(mesh.view());
    EXPECT_THAT(exact.index().check(mesh.view()), testing::IsEmpty()) << exponent;
    for (const double radius : {0.0, 0.5, 1.0, 3.0, 10.0, 20.0, 50.0}) {
      for (const VertexId v : {0U, 435U, 899U}) exact.query(v, std::ldexp(radius, exponent));
    }
    EXPECT_EQ(exact.mismatches(), 0U) << exponent;
  }
}

TEST(Rare, FarFromTheOrigin) {
  for (const double offset : {1e3, 1e6, 1e9, 1e15}) {
    TestMesh mesh = make_grid(50, 50, false);
    for (double& x : mesh.positions) x += offset;
    ExactAnswer exact(mesh.finish(false).view());
    query_everywhere(exact, mesh.size(), {1, 5, 12, 25, 60});
  }
}

TEST(Rare, MeshesOfOneToThirtyThreeVertices) {
  for (const std::size_t vertices : {1U, 2U, 31U, 32U, 33U}) {
    const TestMesh mesh = points_at_random(vertices);
    ExactAnswer exact(mesh.view());
    query_everywhere(exact, vertices, {0, 0.5, kInfinity});
  }
}

}  // namespace
}  // namespace meshhood::test
