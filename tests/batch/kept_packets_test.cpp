// SPDX-License-Identifier: MIT
// What is kept of the packets of a batch is what was found, in no more memory than the ids take; and a batch that keeps
// it has the rows of one that does not.
#include "batch/kept_packets.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/masks.h"

#include "batch/batch.h"
#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// Words of a leaf of which each vertex has others.
PerLane<QueryWord> some_words(QueryWord first) {
  PerLane<QueryWord> words{};
  for (unsigned lane = 0; lane < kLeafCapacity; ++lane) words[lane] = first * (lane + 1) & 7;
  return words;
}

TEST(KeptPackets, AreReadInTheOrderInWhichTheyWereAdded) {
  const PerLane<QueryWord> a = some_words(3);
  const PerLane<QueryWord> b = some_words(5);
  const PerLane<QueryWord> single{1, 0, 1};
  const std::vector<Piece> first{{{10, 11}, 0, a.data()}, {{11, 24}, 5, nullptr}, {{30, 31}, 0, b.data()}};
  const std::vector<Piece> second{{{0, 2}, 1, nullptr}, {{3, 4}, 0, single.data()}};
  KeptPackets kept;
  kept.add(first, std::vector<std::uint64_t>{400, 0, 432});
  kept.add(second, std::vector<std::uint64_t>{62});
  kept.add(first, std::vector<std::uint64_t>{1, 0, 1});
  kept.add(second, std::vector<std::uint64_t>{63});
  KeptPackets::Reader reader;
  reader.begin(kept, {});
  const auto expect_next = [&](const std::vector<Piece>& pieces) {
    ASSERT_EQ(reader.pieces().size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Piece& read = reader.pieces()[i];
      EXPECT_EQ(read.leaves, pieces[i].leaves);
      EXPECT_EQ(read.queries, pieces[i].queries);
      ASSERT_EQ(read.is_run(), pieces[i].is_run());
      if (read.is_run()) continue;
      EXPECT_TRUE(std::equal(read.reached, read.reached + kLeafCapacity, pieces[i].reached));
    }
  };
  ASSERT_TRUE(reader.next());
  expect_next(first);
  EXPECT_EQ(reader.counts()[0], 400U);
  EXPECT_EQ(reader.counts()[1], 0U);
  EXPECT_EQ(reader.counts()[2], 432U);
  ASSERT_TRUE(reader.next());
  expect_next(second);
  EXPECT_EQ(reader.counts()[0], 62U);
  EXPECT_FALSE(reader.next()) << "its two ids take less memory than its pieces";
  ASSERT_TRUE(reader.next());
  expect_next(second);
  EXPECT_EQ(reader.counts()[0], 63U);
}

TEST(KeptPackets, TakeNoMoreMemoryThanTheIds) {
  const PerLane<QueryWord> words = some_words(3);
  const std::vector<Piece> pieces{{{10, 11}, 0, words.data()}, {{11, 12}, 5, nullptr}};
  const auto bytes_of = [&](std::uint64_t ids) {
    KeptPackets packets;
    packets.add(pieces, std::vector<std::uint64_t>{0, ids});
    EXPECT_LE(packets.bytes(), 64 << 10);
    return sizeof(std::uint32_t) * packets.end().word;
  };
  const std::size_t left_out = bytes_of(0);
  EXPECT_LE(left_out, 8U);
  std::size_t kept = 0;
  for (std::uint64_t ids = 0; ids < 100; ++ids) {
    if (bytes_of(ids) == left_out) continue;
    EXPECT_LE(bytes_of(ids), sizeof(VertexId) * ids);
    ++kept;
  }
  EXPECT_GT(kept, 40U);
}

TEST(KeptChunks, AreFoundByTheirNumberWhicheverThreadAddedThem) {
  KeptChunks chunks(2);
  const std::vector<Piece> pieces{{{10, 14}, 1, nullptr}};
  constexpr std::size_t kChunks = 10'000;  // several blocks a thread
  const auto thread_of = [](std::size_t number) { return static_cast<unsigned>(number / 3 % 2); };
  for (std::size_t i = 0; i < kChunks; ++i) {
    const std::size_t number = (i + kChunks / 3) % kChunks;
    KeptPackets& packets = chunks.begin(thread_of(number), number);
    for (std::size_t k = 0; k < number % 3; ++k) packets.add(pieces, std::vector<std::uint64_t>{100 + number + k});
  }
  chunks.finish();
  for (std::size_t number = kChunks; number-- > 0;) {
    for (const unsigned thread : {0U, 1U}) {
      KeptPackets::Reader* const reader = chunks.find(thread, number);
      ASSERT_NE(reader, nullptr);
      for (std::size_t i = 0; i < number % 3; ++i) {
        ASSERT_TRUE(reader->next());
        EXPECT_EQ(reader->counts()[0], 100 + number + i);
        EXPECT_EQ(reader->pieces().size(), 1U);
      }
    }
  }
  EXPECT_NE(chunks.find(0, 0), chunks.find(1, 0)) << "threads read at the same time";
  chunks.clear();
  EXPECT_EQ(chunks.find(0, 7), nullptr);
  EXPECT_EQ(chunks.bytes(), 0U);
}

TEST(KeptChunks, OfMoreRowsThanAreSortedAtATime) {
  // Rows of a triangle, then of two.
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0, 6, 1, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5, 4, 6, 5};
  const Index index = build(positions, corners);
  constexpr std::size_t kFirst = Batch::kMaxRows;
  std::vector<VertexId> vertices(kFirst + 300, 1);
  std::fill(vertices.begin() + kFirst, vertices.end(), 4);
  const Neighborhoods found =
      neighborhoods(index, {.vertices = vertices, .radius = 2, .metric = Metric::Rings}, {}, {.threads = 2});
  ASSERT_EQ(found.ids.size(), 3 * kFirst + 4 * 300);
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    const auto first = found.ids.begin() + static_cast<std::ptrdiff_t>(found.offsets[row]);
    const std::vector<VertexId> expected =
        row < kFirst ? std::vector<VertexId>{0, 1, 2} : std::vector<VertexId>{3, 4, 5, 6};
    ASSERT_EQ(found.offsets[row + 1] - found.offsets[row], expected.size()) << row;
    ASSERT_TRUE(std::is_permutation(expected.begin(), expected.end(), first)) << row;
  }
}

MESHHOOD_SUITE_OF_FAMILIES(KeptRows);

TEST_P(KeptRows, AreThoseThatWereSearchedForEach) {
  Random random(8);
  std::size_t rows = 0;
  for (std::uint64_t seed = 0; seed < scaled(16, 4); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 400);
    if (mesh.size() == 0) continue;
    const Index index = build(mesh.view());
    const std::vector<std::uint8_t> walls = draw_mask(random, mesh.size(), random.below(2) * 9);
    const std::vector<std::uint8_t> ignored = draw_mask(random, mesh.size(), random.below(2) * 4);
    const double scale = random.uniform(0.5, 6);
    for (const bool by_rings : {false, true}) {
      const Index searched = masked(index, {walls, ignored});
      const SearchMethod method = SearchMethod(searched).by(by_rings ? Metric::Rings : Metric::Straight);
      std::vector<VertexId> vertices;
      std::vector<double> radii;
      const std::size_t kept_of = 1 + random.below(4);  // all vertices, or few of each leaf
      for (VertexId v = 0; v < mesh.size(); ++v) {
        if (random.below(kept_of) != 0) continue;
        vertices.push_back(v);
        radii.push_back(random.below(20) == 0 ? kInfinity : scale * random.uniform(0, 1));
      }
      const BatchQuery query{.vertices = vertices, .radius = radii};
      const BatchOptions options{.distances = seed % 3 == 0, .sort = seed % 5 == 0 ? RowSort::Id : RowSort::None};
      const meshhood::Run run{.threads = 1 + static_cast<unsigned>(seed % 2)};
      Neighborhoods expected{{0}, {}, {}};
      for_each_neighborhood(
          method, query,
          [&](const BatchRow& row) {
            expected.ids.insert(expected.ids.end(), row.ids.begin(), row.ids.end());
            expected.distances.insert(expected.distances.end(), row.distances.begin(), row.distances.end());
            expected.offsets.push_back(expected.ids.size());
          },
          options, run);
      meshhood::Run tight = run;  // without room for what is kept
      tight.max_bytes = sizeof(VertexId) * expected.ids.size() + sizeof(double) * expected.distances.size();
      for (const meshhood::Run& given : {run, tight}) {
        const Neighborhoods found = neighborhoods(method, query, options, given);
        ASSERT_EQ(found.offsets, expected.offsets);
        ASSERT_EQ(found.ids, expected.ids);
        ASSERT_EQ(found.distances, expected.distances);
      }
      rows += vertices.size();
    }
  }
  std::printf("%zu rows\n", rows);
}

}  // namespace
}  // namespace meshhood::test
