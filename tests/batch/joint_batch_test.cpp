// SPDX-License-Identifier: MIT
// A batch that answers the rows of a leaf together gives the answers of single queries, in any order and on any number
// of threads.
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "exact/index_access.h"
#include "support/families.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

/// A row as the sink received it.
struct Received {
  std::size_t row;
  std::vector<VertexId> ids;
  std::vector<double> distances;

  friend bool operator==(const Received&, const Received&) = default;
};

std::vector<Received> stream(const Index& index, const BatchQuery& query, const BatchOptions& options,
                             const Run& run = {}) {
  std::vector<Received> rows;
  for_each_neighborhood(
      index, query,
      [&](const BatchRow& row) {
        rows.push_back({row.row, {row.ids.begin(), row.ids.end()}, {row.distances.begin(), row.distances.end()}});
      },
      options, run);
  return rows;
}

class JointBatch : public testing::Test {
 protected:
  JointBatch() {
    for (const VertexId v : shuffled(index.vertex_count())) {
      // Leaves with all, some and hardly any of their vertices, and some of them twice.
      const std::uint32_t leaf = IndexAccess::view(index).slot[v] / kLeafCapacity;
      if (random.below(5) < leaf % 7) vertices.push_back(v);
      if (random.below(10) == 0 && leaf % 3 == 0) vertices.push_back(v);
    }
    for (std::size_t row = 0; row < vertices.size(); ++row) radii.push_back(random.uniform(0, 8));
  }

  std::vector<VertexId> shuffled(std::size_t count) {
    std::vector<VertexId> order(count);
    for (std::size_t i = 0; i < count; ++i) {
      order[i] = static_cast<VertexId>(i);
      std::swap(order[i], order[random.below(i + 1)]);
    }
    return order;
  }

  Random random{5};
  TestMesh mesh = make_grid(60, 70, false).finish(true);
  Index index = build(mesh.view());
  std::vector<VertexId> vertices;
  std::vector<double> radii;
};

TEST_F(JointBatch, RowsAreThoseOfSingleQueries) {
  Searcher searcher(index);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  const std::vector<std::uint64_t> sizes = counts(index, {.vertices = vertices, .radius = radii});
  for (const Received& row : stream(index, {.vertices = vertices, .radius = radii}, {.distances = true})) {
    searcher.neighborhood(vertices[row.row], radii[row.row], ids, distances);
    ASSERT_EQ(sizes[row.row], ids.size());
    ASSERT_EQ(row.distances.size(), row.ids.size());
    for (std::size_t i = 0; i < row.ids.size(); ++i) {
      ASSERT_EQ(row.distances[i], distance(mesh.positions_view(), vertices[row.row], row.ids[i]));
    }
    std::vector<VertexId> found = row.ids;
    std::sort(found.begin(), found.end());
    std::sort(ids.begin(), ids.end());
    ASSERT_EQ(found, ids);
  }
}

TEST_F(JointBatch, IndexOrderPassesTheSameRowsSortedByTheirPlaceInTheIndex) {
  for (const std::size_t buffer : {std::size_t{1000}, std::size_t{100'000}, std::size_t{8} << 20}) {
    const BatchQuery query{.vertices = vertices, .radius = radii};
    const std::vector<Received> in_order =
        stream(index, query, {.sorted = true, .in_index_order = true, .buffer_bytes = buffer});
    ASSERT_EQ(in_order.size(), vertices.size());
    const auto& slot = IndexAccess::view(index).slot;
    EXPECT_TRUE(std::is_sorted(in_order.begin(), in_order.end(), [&](const Received& a, const Received& b) {
      return slot[vertices[a.row]] < slot[vertices[b.row]];
    }));
    std::vector<Received> by_row = in_order;
    std::sort(by_row.begin(), by_row.end(), [](const Received& a, const Received& b) { return a.row < b.row; });
    EXPECT_EQ(by_row, stream(index, query, {.sorted = true}));
  }
}

TEST_F(JointBatch, RowsDoNotDependOnTheThreads) {
  for (const bool in_index_order : {false, true}) {
    const BatchQuery query{.vertices = vertices, .radius = radii};
    const std::vector<Received> rows = stream(index, query, {.in_index_order = in_index_order}, {.threads = 1});
    for (const unsigned threads : {2U, 5U}) {
      EXPECT_EQ(stream(index, query, {.in_index_order = in_index_order}, {.threads = threads}), rows);
    }
  }
}

TEST_F(JointBatch, KeptRowsStayInTheirOrder) {
  const BatchQuery query{.vertices = vertices, .radius = 3};
  const Neighborhoods kept = neighborhoods(index, query, {.sorted = true, .in_index_order = true});
  for (const Received& row : stream(index, query, {.sorted = true})) {
    const std::span<const VertexId> ids(kept.ids.begin() + static_cast<std::ptrdiff_t>(kept.offsets[row.row]),
                                        kept.ids.begin() + static_cast<std::ptrdiff_t>(kept.offsets[row.row + 1]));
    ASSERT_TRUE(std::equal(ids.begin(), ids.end(), row.ids.begin(), row.ids.end()));
  }
}

TEST_F(JointBatch, KeptRowsOfAnotherMethodStayInTheirOrder) {
  const BatchQuery query{.vertices = vertices, .radius = 3};
  const SearchMethod scan = SearchMethod::ball_scan(mesh.positions_view());
  const Neighborhoods kept = neighborhoods(scan, query, {.sorted = true, .in_index_order = true});
  EXPECT_EQ(kept.ids, neighborhoods(scan, query, {.sorted = true}).ids);
}

}  // namespace
}  // namespace meshhood::test
