// SPDX-License-Identifier: MIT
// Batches by the number of edges have the rings of a search over the vertices by the oracle, on every instruction set.
#include <cstdint>
#include <cstdio>
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
#include "support/limited_isa.h"
#include "support/region_oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

class RingsOfFamily : public testing::TestWithParam<Family> {};

TEST_P(RingsOfFamily, AreThoseOfTheOracle) {
  Random random(31);
  std::size_t rows = 0;
  for (std::uint64_t seed = 0; seed < scaled(16, 4); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    const RegionOracle oracle(mesh);
    const Index index = build(mesh.view());
    const LimitedIsa limited(available_isas()[seed % available_isas().size()]);
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
      const PlainStart start{.center = position(mesh, vertices[i]), .seeds = {vertices[i]}, .walls = walls};
      const std::vector<double> edges = oracle.path_lengths(start, radii[i], [](auto, auto) { return 1; });
      std::vector<VertexId> expected;
      for (std::size_t place = 0; place < mesh.size(); ++place) {
        const VertexId w = IndexAccess::view(index).id(place);
        if (edges[w] < kInfinity && ignored[w] == 0) expected.push_back(w);
      }
      const std::size_t begin = found.offsets[i];
      const auto ids = std::span(found.ids).subspan(begin, found.offsets[i + 1] - begin);
      ASSERT_THAT(ids, testing::ElementsAreArray(expected)) << "row " << i << ", radius " << radii[i];
      ASSERT_EQ(sizes[i], expected.size());
      for (std::size_t k = 0; k < ids.size(); ++k) ASSERT_EQ(measured.distances[begin + k], edges[ids[k]]);
    }
    rows += vertices.size();
  }
  std::printf("%zu rows\n", rows);
}

INSTANTIATE_TEST_SUITE_P(Families, RingsOfFamily, testing::ValuesIn(families()), family_name);

TEST(Rings, HaveScalesInCounts) {
  const TestMesh mesh = make_grid(5, 5, true).finish(false);
  const Index index = build(mesh.view());
  const std::vector<VertexId> middle{12};
  EXPECT_THAT(counts(SearchMethod(index).by(Metric::Rings), {middle, BatchRadius::scales({0, 1, 2, 100})}),
              ElementsAre(1, 5, 13, 25));
}

}  // namespace
}  // namespace meshhood::test
