// SPDX-License-Identifier: MIT
// Batches by each metric have the rows of `Searcher`, on every instruction set.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/batch.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"

#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/limited_isa.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

MESHHOOD_SUITE_OF_FAMILIES(RowsOfFamily);

TEST_P(RowsOfFamily, AreThoseOfASearcher) {
  Random random(37);
  std::size_t rows = 0;
  constexpr std::array kMetrics{Metric::Path, Metric::Rings, Metric::Straight, Metric::Space};
  for (std::uint64_t seed = 0; seed < scaled(64, 16); ++seed) {
    const Metric metric = kMetrics[seed % 4];
    const auto [mesh, index] = indexed(make_mesh(GetParam(), seed, 300));
    const LimitedIsa limited(available_isas()[seed / 4 % available_isas().size()]);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), random.below(2) * 9);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), random.below(2) * 4);
    Searcher searcher(index, metric);
    std::vector<VertexId> ids;
    std::vector<double> lengths;
    double longest = 0;
    if (mesh.size() > 0) searcher.neighborhood(0, kInfinity, ids, lengths);
    if (!lengths.empty()) longest = *std::ranges::max_element(lengths);
    std::vector<VertexId> vertices;
    std::vector<double> radii;
    const std::size_t size = random.below(300);  // few rows of a leaf, and many
    for (std::size_t i = 0; mesh.size() > 0 && i < size; ++i) {
      vertices.push_back(static_cast<VertexId>(random.below(mesh.size())));
      radii.push_back(random.below(10) == 0 ? kInfinity : longest * random.uniform(0, 0.6));
    }
    const Index searched = masked(index, {walls, ignored});
    Searcher masked_searcher(searched, metric);
    const SearchMethod method = SearchMethod(searched).by(metric);
    const BatchQuery query{.vertices = vertices, .radius = radii};
    const unsigned threads = 1 + static_cast<unsigned>(seed / 4 % 2);
    const std::vector<std::uint64_t> sizes = counts(method, query, {.threads = threads});
    const Neighborhoods found = neighborhoods(method, query, {}, {.threads = threads});
    const Neighborhoods measured = neighborhoods(method, query, {.distances = true}, {.threads = threads});
    ASSERT_EQ(found.ids, measured.ids);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      masked_searcher.neighborhood(vertices[i], radii[i], ids, lengths);
      const std::size_t begin = found.offsets[i];
      ASSERT_EQ(sizes[i], ids.size());
      ASSERT_THAT(std::span(found.ids).subspan(begin, ids.size()), testing::ElementsAreArray(ids));
      ASSERT_THAT(std::span(measured.distances).subspan(begin, ids.size()), testing::ElementsAreArray(lengths));
    }
    rows += vertices.size();
  }
  std::printf("%zu rows\n", rows);
}

TEST(Rings, HaveScalesInCounts) {
  const auto [mesh, index] = indexed(make_grid(5, 5, true).finish(false));
  const std::vector<VertexId> middle{12};
  EXPECT_THAT(counts(SearchMethod(index).by(Metric::Rings), {middle, BatchRadius::scales({0, 1, 2, 100})}),
              testing::ElementsAre(1, 5, 13, 25));
}

}  // namespace
}  // namespace meshhood::test
