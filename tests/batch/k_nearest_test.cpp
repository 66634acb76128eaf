// SPDX-License-Identifier: MIT
// The nearest connected vertices of many vertices, against single queries and the oracle.
#include "meshhood/k_nearest.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"

#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/limited_isa.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

struct NearestRow {
  std::vector<VertexId> ids;
  std::vector<double> distances;
};

/// All connected vertices up to a radius, in order.
NearestRow nearest_of(const RegionOracle& oracle, const PlainStart& start, double radius) {
  NearestRow row;
  const std::vector<double> radii = oracle.connecting_radii(start, radius);
  row.ids = oracle.in_order(start, radii);
  for (const VertexId v : row.ids) row.distances.push_back(radii[v]);
  return row;
}

NearestRow along_edges(Searcher& searcher, VertexId v, double radius) {
  NearestRow row;
  searcher.nearest_connected(v, searcher.vertex_count(), row.ids, row.distances);
  const auto end = std::ranges::upper_bound(row.distances, radius);
  row.ids.resize(static_cast<std::size_t>(end - row.distances.begin()));
  row.distances.erase(end, row.distances.end());
  return row;
}

NearestRow k_of(const KNearest& found, std::size_t row, std::size_t k) {
  NearestRow result;
  for (std::size_t i = row * k; i < (row + 1) * k; ++i) {
    if (found.ids[i] == kNoVertex) {
      EXPECT_EQ(found.distances[i], kInfinity);
      continue;
    }
    EXPECT_EQ(result.ids.size(), i - row * k) << "a gap in the row";
    result.ids.push_back(found.ids[i]);
    result.distances.push_back(found.distances[i]);
  }
  return result;
}

void cut(NearestRow& row, std::size_t size) {
  row.ids.resize(std::min(size, row.ids.size()));
  row.distances.resize(row.ids.size());
}

MESHHOOD_SUITE_OF_FAMILIES(KNearestIn);

TEST_P(KNearestIn, BeginsAsAllVerticesInOrder) {
  std::size_t rows = 0;
  for (const std::size_t vertices : {1U, 40U, 500U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    if (mesh.size() == 0) continue;
    const Index index = build(mesh.view());
    const RegionOracle oracle(mesh);
    Random random(vertices);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), 8);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), 8);
    std::vector<double> areas(mesh.size());
    for (double& area : areas) area = random.below(4) == 0 ? 0 : random.uniform(0, 1);
    std::vector<VertexId> some;
    for (std::size_t i = 0; i < scaled(40, 10); ++i) some.push_back(static_cast<VertexId>(random.below(mesh.size())));
    const double edge = oracle.graph().mean_edge();
    const double tie = oracle.graph().distance(some[0], some[1]);
    const std::vector<Isa> isas = available_isas();
    for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
      for (const double radius : {kInfinity, metric == Metric::Rings ? 3.5 : 3 * edge, tie, 0.0}) {
        const LimitedIsa limited(isas[random.below(isas.size())]);
        const NearestOptions options{.metric = metric, .radius = radius};
        const Index searched = masked(index, radius != 0 ? Masks{walls, ignored} : Masks{});
        Searcher edges(searched, metric);
        const std::size_t k = 1 + random.below(30);
        const double area = random.uniform(0.5, 6);
        const KNearest found = k_nearest(searched, some, k, options);
        const Neighborhoods disc = discs(searched, some, area, areas, options);
        ASSERT_EQ(found.ids.size(), k * some.size());
        ASSERT_EQ(disc.offsets.size(), some.size() + 1);
        for (std::size_t i = 0; i < some.size(); ++i, ++rows) {
          PlainStart start;
          start.center = position(mesh, some[i]);
          start.seeds = {some[i]};
          start.walls = radius != 0 ? walls : std::vector<std::uint8_t>(mesh.size());
          start.ignored = radius != 0 ? ignored : std::vector<std::uint8_t>(mesh.size());
          NearestRow all =
              metric == Metric::Straight ? nearest_of(oracle, start, radius) : along_edges(edges, some[i], radius);
          std::size_t size = 0;
          for (double sum = 0; size < all.ids.size() && sum < area; ++size) sum += areas[all.ids[size]];
          const std::span<const VertexId> ids =
              std::span(disc.ids).subspan(disc.offsets[i], disc.offsets[i + 1] - disc.offsets[i]);
          ASSERT_THAT(ids, testing::ElementsAreArray(std::span(all.ids).first(size))) << mesh.name << ", " << some[i];
          ASSERT_TRUE(std::equal(ids.begin(), ids.end(), all.ids.begin()));
          for (std::size_t j = 0; j < size; ++j) ASSERT_EQ(disc.distances[disc.offsets[i] + j], all.distances[j]);
          cut(all, k);
          const NearestRow row = k_of(found, i, k);
          ASSERT_EQ(row.ids, all.ids) << mesh.name << ", vertex " << some[i] << ", radius " << radius;
          ASSERT_EQ(row.distances, all.distances);
        }
      }
    }
  }
  std::printf("%s: %zu rows\n", std::string(GetParam().name).c_str(), rows);
}

// Rows of a leaf are searched together, as far as the last row suggests.
TEST_P(KNearestIn, AllVerticesHaveTheRowsOfSingleQueries) {
  for (const std::size_t vertices : {60U, 1500U}) {
    const TestMesh mesh = make_mesh(GetParam(), 3, scaled(vertices, 60));
    Random random(vertices);
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), 5);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), 5);
    const Index index = build(mesh.view());
    const Index with_masks = masked(index, {.walls = walls, .ignored = ignored});
    for (const Index* const searched : {&index, &with_masks}) {
      Searcher searcher(*searched);
      for (const std::size_t k : {1U, 20U, 300U}) {
        const KNearest found = k_nearest(*searched, {}, k, {}, {.threads = 2});
        for (VertexId v = 0; v < mesh.size(); ++v) {
          NearestRow expected;
          searcher.nearest_connected(v, k, expected.ids, expected.distances);
          const NearestRow row = k_of(found, v, k);
          ASSERT_EQ(row.ids, expected.ids) << mesh.name << ", vertex " << v << ", k " << k;
          ASSERT_EQ(row.distances, expected.distances);
        }
      }
    }
  }
}

TEST(KNearest, DiscsOfAPlaneHaveTheirArea) {
  const auto [mesh, index] = indexed(make_grid(60, 60, false));
  const std::vector<double> areas = vertex_areas(mesh.view());
  const std::vector<VertexId> middle{60 * 30 + 30};
  for (const Metric metric : {Metric::Straight, Metric::Path}) {
    const Neighborhoods disc = discs(index, middle, 99.5, areas, {.metric = metric});
    EXPECT_EQ(disc.ids.size(), 100U);
    EXPECT_EQ(disc.ids.front(), middle.front());
  }
}

TEST(KNearest, RefusesWrongArguments) {
  const auto [mesh, index] = indexed(make_grid(4, 4, false));
  const std::vector<VertexId> vertices{1, 16};
  const std::vector<double> areas(16, 1.0);
  std::vector<double> wrong = areas;
  wrong[3] = -1;
  expect_refused(ErrorCode::VertexOutOfRange, "row 1: vertex 16", [&] { return k_nearest(index, vertices, 3); });
  expect_refused(ErrorCode::InvalidRadius, "-2", [&] { return k_nearest(index, {}, 3, {.radius = -2}); });
  std::vector<VertexId> ids;
  std::vector<double> radii;
  expect_refused(ErrorCode::InvalidOption, "k: 0, expected at least 1", [&] { return k_nearest(index, {}, 0); });
  expect_refused(ErrorCode::InvalidOption, "k: 0, expected at least 1",
                 [&] { Searcher(index).nearest_connected(0, 0, ids, radii); });
  expect_refused(ErrorCode::TooLarge, "rows, expected at most",
                 [&] { return k_nearest(index, {}, std::numeric_limits<std::size_t>::max() / 4); });
  expect_refused(ErrorCode::InvalidOption, "area: 0", [&] { return discs(index, {}, 0, areas); });
  expect_refused(ErrorCode::InvalidOption, "areas: vertex 3 has -1", [&] { return discs(index, {}, 1, wrong); });
  expect_refused(ErrorCode::InvalidOption, "areas: 2 values",
                 [&] { return discs(index, {}, 1, std::span(areas).first(2)); });
}

TEST(KNearest, WritesAllOfTheMemoryOfTheCaller) {
  const auto [mesh, index] = indexed(make_grid(2, 3, false));
  const std::vector<VertexId> vertices{4, 0};
  const std::size_t k = mesh.size() + 1;
  std::vector<VertexId> ids;
  std::vector<double> distances;
  const auto write = [&](std::size_t missing_ids, std::size_t missing_distances) {
    const auto allocate = [&](std::size_t count) -> BatchMemory {
      ids.assign(count - missing_ids, 77);
      distances.assign(count - missing_distances, -1);
      return {ids, distances};
    };
    k_nearest(index, vertices, k, allocate);
  };
  write(0, 0);
  const KNearest expected = k_nearest(index, vertices, k);
  EXPECT_EQ(ids, expected.ids);
  EXPECT_EQ(distances, expected.distances);
  EXPECT_EQ(ids.back(), kNoVertex);
  EXPECT_EQ(distances.back(), std::numeric_limits<double>::infinity());
  const std::string size = std::to_string(vertices.size() * k - 1);
  expect_refused(ErrorCode::InvalidOption, "memory for " + size + " ids", [&] { write(1, 0); });
  expect_refused(ErrorCode::InvalidOption, "memory for " + size + " distances", [&] { write(0, 1); });
}

TEST(KNearest, RefusesAResultBeyondTheLimit) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const std::vector<double> areas(mesh.size(), 1.0);
  const std::uint64_t bytes = 12 * 20 * mesh.size();
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
    const NearestOptions options{.metric = metric};
    meshhood::Run run{.threads = 2, .max_bytes = bytes};
    EXPECT_EQ(k_nearest(index, {}, 20, options, run).ids.size(), bytes / 12);
    EXPECT_EQ(discs(index, {}, 20, areas, options, run).ids.size(), bytes / 12);
    --run.max_bytes;
    const std::string message = " bytes, exceeds max_bytes, " + std::to_string(run.max_bytes);
    expect_refused(ErrorCode::TooLarge, message, [&] { return k_nearest(index, {}, 20, options, run); });
    expect_refused(ErrorCode::TooLarge, message, [&] { return discs(index, {}, 20, areas, options, run); });
  }
}

TEST(KNearest, RefusesDiscsFarBeyondTheLimitByASample) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const std::vector<double> areas(mesh.size(), 1.0);
  const std::vector<VertexId> vertices(10'000, VertexId{7});
  std::size_t most = 0;
  const meshhood::Run run{.progress =
                              [&](std::size_t done, std::size_t) {
                                most = std::max(most, done);
                                return true;
                              },
                          .max_bytes = std::uint64_t{12} * 100 * vertices.size()};
  expect_refused(ErrorCode::TooLarge, "at least about", [&] { return discs(index, vertices, 1e9, areas, {}, run); });
  EXPECT_EQ(most, 0U) << "rows of the refused call were searched";
}

TEST(KNearest, ReturnsDiscsWithinTheLimitThatTheSampleDoesNotExclude) {
  // A component of one vertex and one of many: half of the rows are large, and their sample does not prove that the
  // result is too large.
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const std::vector<double> areas(mesh.size(), 1.0);
  std::vector<std::uint8_t> walls(mesh.size(), 0);
  walls[5] = 1;
  std::vector<VertexId> vertices(10'000, VertexId{7});
  std::fill_n(vertices.begin(), vertices.size() / 2, VertexId{5});
  const std::uint64_t ids = (mesh.size() - 1) * (vertices.size() / 2);
  const meshhood::Run run{.max_bytes = 12 * ids};
  EXPECT_EQ(discs(masked(index, {.walls = walls}), vertices, 1e9, areas, {}, run).ids.size(), ids);
}

TEST(KNearest, StopsWhenItIsCancelled) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  expect_refused(ErrorCode::Cancelled, "", [&] {
    return k_nearest(index, {}, 5, {}, {.progress = [](std::size_t, std::size_t) { return false; }});
  });
}

}  // namespace
}  // namespace meshhood::test
