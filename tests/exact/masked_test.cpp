// SPDX-License-Identifier: MIT
// Answers with walls are those of the reference search on the graph without the walls; ignored vertices are left out of
// them. Single queries, counts, ids and distances of batches of all vertices, with masks and without, on every
// instruction set.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/batch.h"
#include "meshhood/curvature.h"
#include "meshhood/masks.h"
#include "meshhood/refit.h"
#include "meshhood/serialize.h"

#include "exact/index_access.h"
#include "exact/query/single_queries.h"
#include "exact/search/vertex_bfs.h"
#include "support/draw.h"
#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/limited_isa.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/sorted.h"
#include "support/without_walls.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// Every vertex, one in several, the vertices of some leaves, of a block of leaves, or none.
std::vector<std::uint8_t> draw_region(Random& random, const IndexView& index) {
  const std::size_t size = index.vertex_count();
  std::vector<std::uint8_t> mask(size);
  const auto leaf = [&](std::size_t v) { return index.slot[v] / kLeafCapacity; };
  switch (random.below(7)) {
    case 0: return mask;
    case 1: return draw_mask(random, size, 1);
    case 2: return draw_mask(random, size, 2);
    case 3: return draw_mask(random, size, 9);
    case 4: return draw_mask(random, size, 200);
    case 5:
      for (std::size_t v = 0; v < size; ++v) mask[v] = leaf(v) % 5 == 2 ? 1 : 0;
      return mask;
    default:
      for (std::size_t v = 0; v < size; ++v) mask[v] = leaf(v) / 8 % 3 == 1 ? 1 : 0;
      return mask;
  }
}

/// A mesh with masks, and the answers of the reference.
class MaskedCase {
 public:
  MaskedCase(TestMesh mesh, Random& random, bool has_masks = true)
      : mesh_(std::move(mesh)),
        index_(build(mesh_.view())),
        has_masks_(has_masks),
        walls_(has_masks ? draw_region(random, IndexAccess::view(index_)) : std::vector<std::uint8_t>(size())),
        ignored_(has_masks ? draw_region(random, IndexAccess::view(index_)) : std::vector<std::uint8_t>(size())),
        graph_(without_walls(mesh_, walls_)),
        reference_(GraphView{mesh_.positions_view(), graph_.view()}) {}

  [[nodiscard]] const Index& index() const { return index_; }
  [[nodiscard]] const TestMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::size_t size() const { return mesh_.size(); }
  [[nodiscard]] Index masked() const {
    return meshhood::masked(index_, has_masks_ ? Masks{walls_, ignored_} : Masks{});
  }

  /// Ascending ids.
  const std::vector<VertexId>& expected(VertexId v, double radius) {
    ids_.clear();
    if (walls_[v] != 0) return ids_;
    reference_.neighborhood(v, radius, ids_);
    std::erase_if(ids_, [&](VertexId w) { return ignored_[w] != 0; });
    std::sort(ids_.begin(), ids_.end());
    return ids_;
  }

 private:
  TestMesh mesh_;
  Index index_;
  bool has_masks_;
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
  Adjacency graph_;
  ReferenceSearcher reference_;
  std::vector<VertexId> ids_;
};

/// How many queries had which way.
struct Ways {
  std::size_t queries = 0;
  std::size_t reach = 0;
  std::size_t walls = 0;
  std::size_t rows = 0;
};

void compare_single(MaskedCase& scene, Random& random, const Oracle& oracle, Ways& ways) {
  const Index searched = scene.masked();
  std::vector<Searcher> searchers = searchers_of(searched);
  for (int i = 0; i < 6; ++i) {
    const auto v = static_cast<VertexId>(random.below(scene.size()));
    for (const double radius : draw_radii(random, oracle, v)) {
      Searcher& searcher = searchers[ways.queries++ % searchers.size()];
      const auto& expected = scene.expected(v, radius);
      ASSERT_EQ(sorted(searcher.neighborhood(v, radius)), expected) << "vertex " << v << ", radius " << radius;
      ASSERT_EQ(searcher.count(v, radius), expected.size());
      const auto way = SearcherAccess::state(searcher).way;
      ways.reach += static_cast<std::size_t>(way == SearcherAccess::State::Way::Component);
      ways.walls += static_cast<std::size_t>(way == SearcherAccess::State::Way::Wall);
    }
  }
}

void compare_batch(MaskedCase& scene, double radius, unsigned threads, Ways& ways) {
  const Index index = scene.masked();
  const BatchQuery query{.radius = radius};
  const Neighborhoods found = neighborhoods(index, query, {.distances = true}, {.threads = threads});
  const std::vector<std::uint64_t> sizes = counts(index, query, {.threads = threads});
  ASSERT_EQ(sizes.size(), scene.size());
  const auto& slot = IndexAccess::view(index).slot;
  for (VertexId v = 0; v < scene.size(); ++v) {
    const std::size_t begin = found.offsets[v];
    const auto ids = std::span(found.ids).subspan(begin, found.offsets[v + 1] - begin);
    ASSERT_EQ(sorted({ids.begin(), ids.end()}), scene.expected(v, radius)) << "vertex " << v << ", radius " << radius;
    ASSERT_EQ(sizes[v], ids.size());
    ASSERT_TRUE(std::ranges::is_sorted(ids, {}, [&](VertexId w) { return slot[w]; })) << "index order";
    for (std::size_t i = 0; i < ids.size(); ++i) {
      ASSERT_EQ(found.distances[begin + i], distance(scene.mesh().positions_view(), v, ids[i]));
    }
  }
  ways.rows += scene.size();
}

MESHHOOD_SUITE_OF_FAMILIES(MaskedFamily);

TEST_P(MaskedFamily, GivesTheAnswersOfTheGraphWithoutWalls) {
  Random random(11);
  Ways ways;
  const std::vector<Isa> isas = available_isas();
  for (std::uint64_t seed = 0; seed < scaled(60, 6); ++seed) {
    const std::size_t size = seed % 8 == 7 ? 1 + seed / 8 : draw_size(seed);
    MaskedCase scene(make_mesh(GetParam(), seed, size), random, seed % 3 != 2);
    if (scene.size() == 0) continue;
    const Oracle oracle(scene.mesh());
    ASSERT_NO_FATAL_FAILURE(compare_single(scene, random, oracle, ways));
    const std::vector<double> radii =
        draw_radii(random, oracle, static_cast<std::uint32_t>(random.below(scene.size())));
    const LimitedIsa limited(isas[seed % isas.size()]);
    for (std::size_t i = 0; i < (scene.size() > 1000 ? 1 : 3); ++i) {
      ASSERT_NO_FATAL_FAILURE(
          compare_batch(scene, radii[random.below(radii.size())], 1 + static_cast<unsigned>(seed % 2), ways));
    }
  }
  std::printf("%zu single queries, of which %zu by the outward search and %zu of walls; %zu rows\n", ways.queries,
              ways.reach, ways.walls, ways.rows);
}

/// Large enough for cores, whole nodes of several levels, and packets of one group with and without walls.
TEST(Masked, GivesTheAnswersOfTheGraphWithoutWallsOnALargeSheet) {
  Random random(4);
  Ways ways;
  for (std::size_t round = 0; round < scaled(10, 2); ++round) {
    MaskedCase scene(bumpy_grid(70), random);
    const Oracle oracle(scene.mesh());
    ASSERT_NO_FATAL_FAILURE(compare_single(scene, random, oracle, ways));
    ASSERT_NO_FATAL_FAILURE(compare_batch(scene, random.uniform(2, 25), 2, ways));
  }
  std::printf("%zu single queries, of which %zu by the outward search and %zu of walls; %zu rows\n", ways.queries,
              ways.reach, ways.walls, ways.rows);
  EXPECT_GT(ways.reach, 0U);
  EXPECT_GT(ways.walls, 0U);
}

TEST(Masked, GivesRowsWithRadiiOfTheirOwnAndOfChosenVertices) {
  Random random(5);
  MaskedCase scene(bumpy_grid(40), random);
  const Index index = scene.masked();
  std::vector<VertexId> rows;
  std::vector<double> radii;
  for (int i = 0; i < 900; ++i) {
    rows.push_back(static_cast<VertexId>(random.below(scene.size())));
    radii.push_back(random.uniform(0, 9));
  }
  const std::vector<std::uint64_t> sizes = counts(index, {.vertices = rows, .radius = radii});
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(sizes[i], scene.expected(rows[i], radii[i]).size());
  const std::vector<std::uint64_t> scaled_sizes =
      counts(index, {.vertices = rows, .radius = BatchRadius::scales({5, 1.5})});
  ASSERT_EQ(scaled_sizes.size(), 2 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(scaled_sizes[i], scene.expected(rows[i], 5).size());
    ASSERT_EQ(scaled_sizes[rows.size() + i], scene.expected(rows[i], 1.5).size());
  }
}

TEST(Masked, HasACopyOfTheMasks) {
  const auto [mesh, index] = indexed(bumpy_grid(60));
  std::vector<std::uint8_t> walls(mesh.size());
  for (std::size_t v = 0; v < mesh.size(); v += 7) walls[v] = 1;
  const Index searched = masked(index, {.walls = walls});
  const Index same = masked(index, {.walls = walls}, {.threads = 3});
  std::ranges::fill(walls, std::uint8_t{1});
  EXPECT_EQ(counts(searched, {.radius = 2}), counts(same, {.radius = 2}));
  EXPECT_GT(counts(searched, {.radius = 2})[1], 1U);
  EXPECT_EQ(fingerprint(searched), fingerprint(index)) << "the mesh is the whole one";
}

TEST(Masked, RefusesMasksOfAnotherSizeAndWhatWouldLoseThem) {
  const TestMesh mesh = make_grid(4, 4, false).finish(false);
  Index index = build(mesh.view());
  const std::vector<std::uint8_t> short_mask(8);
  const std::vector<std::uint8_t> mask(16);
  expect_refused(ErrorCode::InvalidOption, "walls: 8 values, expected one for each of 16 vertices",
                 [&] { return masked(index, {.walls = short_mask}); });
  expect_refused(ErrorCode::InvalidOption, "ignored: 8 values", [&] { return masked(index, {.ignored = short_mask}); });
  for (const Masks& masks : {Masks{.walls = mask}, Masks{}}) {
    Index searched = masked(index, masks);
    expect_refused(ErrorCode::InvalidOption, "masked again", [&] { return masked(searched, masks); });
    expect_refused(ErrorCode::InvalidOption, "not saved", [&] { save(searched, [](std::span<const std::byte>) {}); });
    expect_refused(ErrorCode::InvalidOption, "not checked", [&] { return searched.check(mesh.view()); });
    expect_refused(ErrorCode::InvalidOption, "not refitted", [&] { return refit(searched, mesh.positions_view()); });
    expect_refused(ErrorCode::InvalidOption, "not refitted", [&] { searched.refit_in_place(mesh.positions_view()); });
  }
  const Index searched = masked(index, {.walls = mask});
  index.refit_in_place(mesh.positions_view());
  expect_refused(ErrorCode::InvalidOption, "refitted in place", [&] { return counts(searched, {.radius = 1}); });
}

TEST(Masked, SharesTheNormalsOfASurface) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(12));
  const std::vector<std::uint8_t> walls(mesh.size());
  const Surface same = surface.on(masked(index, {.walls = walls}));
  EXPECT_EQ(curvatures(same, {.radius = 3}).k1, curvatures(surface, {.radius = 3}).k1);
  const Index other = build(mesh.view());
  expect_refused(ErrorCode::InvalidOption, "of another mesh", [&] { return surface.on(other); });
}

/// Many vertices in one packet that no wall touches, beside one that loses all of its queries. Balls with the larger
/// radius have whole leaves in common.
TEST(Masked, AnswersWallsInTheMiddleOfALeaf) {
  Random random(9);
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const IndexView& view = IndexAccess::view(index);
  for (LeafId leaf = 0; leaf < view.leaf_count(); ++leaf) {
    if (view.leaves[leaf].size == 0) continue;
    std::vector<std::uint8_t> walls(mesh.size());
    for (std::size_t lane = 0; lane < view.leaves[leaf].size; ++lane) {
      walls[view.id(view.leaves[leaf].first + lane)] = lane % 2 == 0 || leaf % 2 == 0 ? 1 : 0;
    }
    const Adjacency graph = without_walls(mesh, walls);
    ReferenceSearcher reference(GraphView{mesh.positions_view(), graph.view()});
    for (const double radius : {6.0, 15.0}) {
      const Index searched = masked(index, {.walls = walls});
      const std::vector<std::uint64_t> sizes = counts(searched, {.radius = radius});
      for (VertexId v = 0; v < mesh.size(); ++v) {
        ASSERT_EQ(sizes[v], walls[v] != 0 ? 0 : reference.count(v, radius)) << "vertex " << v << ", leaf " << leaf;
      }
    }
  }
}

}  // namespace
}  // namespace meshhood::test
