// SPDX-License-Identifier: MIT
// Batches by the number of edges have the rings of a breadth-first search over the vertices, on every instruction set.
#include "batch/ring_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/batch.h"
#include "meshhood/masks.h"

#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/oracle.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();

/// The number of edges from `v` to each vertex.
std::vector<std::uint32_t> edges_from(const Oracle& graph, VertexId v, const std::vector<std::uint8_t>& walls) {
  std::vector<std::uint32_t> edges(graph.size(), kFar);
  if (walls[v] != 0) return edges;
  std::vector<std::uint32_t> queue{v};
  edges[v] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t w : graph.neighbors(queue[head])) {
      if (walls[w] != 0 || edges[w] != kFar) continue;
      edges[w] = edges[queue[head]] + 1;
      queue.push_back(w);
    }
  }
  return edges;
}

class RingsOfFamily : public testing::TestWithParam<Family> {};

TEST_P(RingsOfFamily, AreThoseOfABreadthFirstSearch) {
  Random random(31);
  const Isa best = best_isa();
  std::size_t rows = 0;
  for (std::uint64_t seed = 0; seed < scaled(16, 4); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    const Oracle graph(mesh);
    const Index index = build(mesh.view());
    limit_isa(available_isas()[seed % available_isas().size()]);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), random.below(2) * 9);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), random.below(2) * 4);
    std::vector<VertexId> vertices;
    std::vector<double> radii;
    for (std::size_t i = 0; mesh.size() > 0 && i < 150; ++i) {
      vertices.push_back(static_cast<VertexId>(random.below(mesh.size())));
      radii.push_back(random.below(10) == 0 ? kInfinity : random.uniform(0, 9));
    }
    const Index searched = masked(index, {walls, ignored});
    const SearchMethod method = SearchMethod(searched).by(Metric::Rings);
    const BatchQuery query{.vertices = vertices, .radius = radii};
    const unsigned threads = 1 + static_cast<unsigned>(seed % 2);
    const std::vector<std::uint64_t> sizes = counts(method, query, {.threads = threads});
    const Neighborhoods found = neighborhoods(method, query, {}, {.threads = threads});
    const Neighborhoods measured = neighborhoods(method, query, {.distances = true}, {.threads = threads});
    ASSERT_EQ(found.ids, measured.ids);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::vector<std::uint32_t> edges = edges_from(graph, vertices[i], walls);
      std::vector<VertexId> expected;
      for (std::size_t place = 0; place < mesh.size(); ++place) {
        const VertexId w = IndexAccess::view(index).id(place);
        if (edges[w] != kFar && edges[w] <= radii[i] && ignored[w] == 0) expected.push_back(w);
      }
      const std::size_t begin = found.offsets[i];
      const auto ids = std::span(found.ids).subspan(begin, found.offsets[i + 1] - begin);
      ASSERT_THAT(ids, testing::ElementsAreArray(expected)) << "row " << i << ", radius " << radii[i];
      ASSERT_EQ(sizes[i], expected.size());
      for (std::size_t k = 0; k < ids.size(); ++k) ASSERT_EQ(measured.distances[begin + k], edges[ids[k]]);
    }
    rows += vertices.size();
  }
  limit_isa(best);
  std::printf("%zu rows\n", rows);
}

INSTANTIATE_TEST_SUITE_P(Families, RingsOfFamily, testing::ValuesIn(families()), family_name);

TEST(Rings, OfASearcherAreThoseOfABatch) {
  const TestMesh mesh = make_grid(7, 9, false).finish(true);
  const Index index = build(mesh.view());
  const SearchMethod method = SearchMethod(index).by(Metric::Rings);
  auto searcher = std::get<Searcher>(method.make_searcher());
  const Neighborhoods found = neighborhoods(method, {.radius = 2.5}, {.distances = true});
  std::vector<VertexId> ids;
  std::vector<double> distances;
  for (VertexId v = 0; v < mesh.size(); ++v) {
    const std::size_t size = found.offsets[v + 1] - found.offsets[v];
    searcher.neighborhood(v, 2, ids, distances);
    ASSERT_THAT(ids, testing::ElementsAreArray(std::span(found.ids).subspan(found.offsets[v], size)));
    ASSERT_THAT(distances, testing::ElementsAreArray(std::span(found.distances).subspan(found.offsets[v], size)));
    ASSERT_EQ(searcher.neighborhood(v, 2), ids);
    ASSERT_EQ(searcher.count(v, 2), size);
    std::size_t in_ranges = 0;
    for (const VertexRange& range : searcher.ranges(v, 2)) in_ranges += range.size();
    ASSERT_EQ(in_ranges, size);
  }
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { static_cast<void>(searcher.count(0, -1)); });
  expect_refused(ErrorCode::VertexOutOfRange, "63", [&] { static_cast<void>(searcher.count(63, 1)); });
}

TEST(Rings, HaveScalesInCounts) {
  const TestMesh mesh = make_grid(5, 5, true).finish(false);
  const Index index = build(mesh.view());
  const std::vector<VertexId> middle{12};
  EXPECT_THAT(counts(SearchMethod(index).by(Metric::Rings), {middle, BatchRadius::scales({0, 1, 2, 100})}),
              ElementsAre(1, 5, 13, 25));
}

}  // namespace
}  // namespace meshhood::test
