// SPDX-License-Identifier: MIT
// The kernels of the joint search give the results of their definitions, with the same bits on every processor.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simd/joint.h"
#include "support/exact_answer.h"
#include "support/plain_kernels.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class EveryJointPath : public testing::TestWithParam<Isa> {
 protected:
  QueryWord random_word() { return static_cast<QueryWord>(random.bits()); }

  PerLane<QueryWord> random_words() {
    PerLane<QueryWord> words;
    for (QueryWord& word : words) word = random_word() & random_word();
    return words;
  }

  float coordinate() { return static_cast<float>(random.uniform(-1, 1)); }

  const JointKernels& tried = joint_kernels(GetParam());
  const JointKernels& plain = kPlainJointKernels;
  Random random{11};
};

TEST_P(EveryJointPath, PointsAreRoundedOnceAndZeroBeyondTheLeaf) {
  for (std::size_t round = 0; round < scaled(2000, 100); ++round) {
    const unsigned size = 1 + static_cast<unsigned>(random.below(kLeafCapacity));
    std::vector<float> xyz(std::size_t{3} * kLeafCapacity);
    for (float& value : xyz) value = 100 * coordinate();
    const FloatCenter center{coordinate(), coordinate(), coordinate(), std::ldexp(1.0F, -7)};
    LeafPoints points;
    tried.convert_points(xyz.data(), size, center, points);
    for (std::size_t i = 0; i < kLeafCapacity; ++i) {
      const auto relative = [&](std::size_t axis, float origin) {
        return i < size ? static_cast<float>(double{xyz[3 * i + axis]} - double{origin}) * center.scale : 0;
      };
      ASSERT_EQ(points.x[i], relative(0, center.x));
      ASSERT_EQ(points.y[i], relative(1, center.y));
      ASSERT_EQ(points.z[i], relative(2, center.z));
      ASSERT_EQ(points.square[i], (points.x[i] * points.x[i] + points.y[i] * points.y[i]) + points.z[i] * points.z[i]);
    }
  }
}

TEST_P(EveryJointPath, ClearedWordsReachNothing) {
  LeafWords words{random_words(), random_words(), random_words()};
  const PerLane<QueryWord> inside = words.inside;
  tried.clear_words(words);
  EXPECT_EQ(words.reached, PerLane<QueryWord>{});
  EXPECT_EQ(words.pending, PerLane<QueryWord>{});
  EXPECT_EQ(words.inside, inside);
}

TEST_P(EveryJointPath, BallWordsAreThoseOfThePlainKernel) {
  std::size_t doubts = 0;
  for (std::size_t round = 0; round < scaled(4000, 200); ++round) {
    const unsigned size = 1 + static_cast<unsigned>(random.below(kLeafCapacity));
    LeafPoints points{};
    for (std::size_t i = 0; i < size; ++i) {
      points.x[i] = coordinate();
      points.y[i] = coordinate();
      points.z[i] = coordinate();
      points.square[i] = (points.x[i] * points.x[i] + points.y[i] * points.y[i]) + points.z[i] * points.z[i];
    }
    PacketBalls balls{};
    balls.queries = random_word();
    for (std::size_t i = 0; i < kPacketCapacity; ++i) {
      balls.x[i] = coordinate();
      balls.y[i] = coordinate();
      balls.z[i] = coordinate();
      const float threshold = coordinate();
      const bool exists = (balls.queries >> i & 1U) != 0;
      balls.surely_inside[i] = exists ? threshold : std::numeric_limits<float>::infinity();
      balls.maybe_inside[i] = exists ? threshold - 0.05F : std::numeric_limits<float>::infinity();
    }
    balls.center.x = coordinate();
    balls.inside_all = static_cast<float>(random.uniform(0, 0.5));
    balls.outside_all = balls.inside_all + static_cast<float>(random.uniform(0, 2));
    PerLane<QueryWord> expected;
    PerLane<QueryWord> found;
    PerLane<QueryWord> expected_doubts{};
    PerLane<QueryWord> found_doubts{};
    const BallWords a = plain.ball_words(points, first_lanes(size), balls, expected, expected_doubts);
    const BallWords b = tried.ball_words(points, first_lanes(size), balls, found, found_doubts);
    ASSERT_EQ(found, expected);
    ASSERT_EQ(b.all, a.all);
    ASSERT_EQ(b.in_doubt, a.in_doubt);
    QueryWord all = balls.queries;
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      const LaneMask bit = LaneMask{1} << lane;
      ASSERT_TRUE(lane < size || found[lane] == 0);
      ASSERT_TRUE((a.in_doubt & bit) == 0 || found_doubts[lane] == expected_doubts[lane]);
      if (lane < size) all &= found[lane];
    }
    ASSERT_EQ(b.all, all);
    doubts += static_cast<std::size_t>(std::popcount(a.in_doubt));
  }
  ASSERT_GT(doubts, 0U);
  std::printf("%zu lanes in doubt\n", doubts);
}

/// The expected words: bits move along edges between lanes whose `inside` has them, until none can.
PerLane<QueryWord> spread_by_definition(const LeafWords& words, const std::vector<LaneMask>& adjacency) {
  PerLane<QueryWord> reached = words.reached;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) reached[i] |= words.pending[i] & words.inside[i];
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t i = 0; i < kLeafCapacity; ++i) {
      for (std::size_t j = 0; j < kLeafCapacity; ++j) {
        if ((adjacency[i] >> j & 1U) == 0) continue;
        const QueryWord grown = reached[j] | (reached[i] & words.inside[j]);
        grows |= grown != reached[j];
        reached[j] = grown;
      }
    }
  }
  return reached;
}

TEST_P(EveryJointPath, SpreadingFollowsEveryEdgeWithinTheBalls) {
  std::size_t closed = 0;
  for (std::size_t round = 0; round < 4000; ++round) {  // fewer might close no leaf
    std::vector<LaneMask> adjacency(kLeafCapacity);
    for (std::size_t edge = 0; edge < 20 + random.below(60); ++edge) {
      const std::size_t i = random.below(kLeafCapacity);
      const std::size_t j = random.below(kLeafCapacity);
      adjacency[i] |= LaneMask{1} << j;
      adjacency[j] |= LaneMask{1} << i;
    }
    LeafWords words;
    words.inside = random_words();
    if (random.below(2) == 0) words.inside.fill(random_word());
    words.pending = random_words();
    words.reached = random_words();
    for (std::size_t i = 0; i < kLeafCapacity; ++i) words.reached[i] &= words.inside[i] & random_word();
    // Bits that were reached before have been spread already.
    LeafWords before = words;
    before.pending = {};
    words.reached = spread_by_definition(before, adjacency);
    const PerLane<QueryWord> expected = spread_by_definition(words, adjacency);
    LeafWords found = words;
    const SpreadWords result = tried.spread_words(found, adjacency.data(), 0);
    ASSERT_EQ(found.reached, expected);
    ASSERT_EQ(found.inside, words.inside);
    ASSERT_EQ(found.pending, PerLane<QueryWord>{});
    ASSERT_EQ(result.closed, expected == words.inside);
    for (std::size_t i = 0; i < kLeafCapacity; ++i) {
      ASSERT_EQ((result.gained >> i & 1U) != 0, expected[i] != words.reached[i]);
    }
    closed += static_cast<std::size_t>(result.closed);
  }
  ASSERT_GT(closed, 0U);
}

TEST_P(EveryJointPath, AStepFollowsEveryEdgeOnce) {
  std::size_t ended = 0;
  for (std::size_t round = 0; round < 2000; ++round) {
    std::vector<LaneMask> adjacency(kLeafCapacity);
    for (LaneMask& lanes : adjacency) lanes = random_word() & random_word() & random_word();
    for (unsigned i = 0; i < kLeafCapacity; ++i) {
      for (unsigned j = 0; j < i; ++j) adjacency[i] = (adjacency[i] & ~(1U << j)) | ((adjacency[j] >> i & 1U) << j);
    }
    LeafWords words;
    words.inside = random_words();
    words.pending = random_words();
    words.reached = random_words();
    FreshWords fresh{random_words()};
    LaneMask from = random.below(8) == 0 ? 0 : random_word();
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      if ((from >> lane & 1U) == 0) fresh[lane] = 0;
      words.reached[lane] |= fresh[lane];
    }
    for (int step = 0; step < 3; ++step) {
      const QueryWord alive = random.below(4) == 0 ? random_word() : ~QueryWord{0};
      const LaneMask open = random.below(2) == 0 ? random_word() : ~LaneMask{0};
      LeafWords expected = words;
      FreshWords expected_fresh = fresh;
      const LaneMask lanes = plain.step_words(expected, expected_fresh, adjacency.data(), from, open, alive);
      ASSERT_EQ(tried.step_words(words, fresh, adjacency.data(), from, open, alive), lanes);
      ASSERT_EQ(words.reached, expected.reached);
      ASSERT_EQ(words.pending, expected.pending);
      ASSERT_EQ(fresh, expected_fresh);
      from = lanes;
      ended += static_cast<std::size_t>(lanes == 0);
    }
  }
  ASSERT_GT(ended, 0U);
}

TEST_P(EveryJointPath, QueriesThatHoldAConnectedLeafReachAllOfItAtOnce) {
  for (std::size_t round = 0; round < 1000; ++round) {
    const unsigned size = 2 + static_cast<unsigned>(random.below(kLeafCapacity - 1));
    std::vector<LaneMask> path(kLeafCapacity);
    for (unsigned i = 0; i + 1 < size; ++i) {
      path[i] |= LaneMask{2} << i;
      path[i + 1] |= LaneMask{1} << i;
    }
    LeafWords words{};
    const QueryWord whole = random_word();
    for (unsigned i = 0; i < size; ++i) words.inside[i] = random_word() | whole;
    words.pending = random_words();
    LeafWords expected = words;
    static_cast<void>(plain.spread_words(expected, path.data(), 0));
    static_cast<void>(tried.spread_words(words, path.data(), whole));
    ASSERT_EQ(words.reached, expected.reached);
  }
}

TEST_P(EveryJointPath, CountsAndLanesAgree) {
  for (const std::size_t leaves : {0U, 1U, 2U, 3U, 4U, 7U, 8U, 15U, 16U, 31U, 33U, 100U, 1025U}) {
    std::vector<LeafWords> words(leaves);
    std::vector<LeafOfWords> list(leaves);
    for (std::size_t i = 0; i < leaves; ++i) {
      words[i].reached = random_words();
      if (random.below(8) == 0) words[i].reached.fill(~QueryWord{0});
      list[i] = {static_cast<std::uint32_t>(leaves - 1 - i), static_cast<std::uint32_t>(kLeafCapacity * i)};
    }
    PerLane<std::uint64_t> counts;
    counts.fill(3);
    tried.count_words(words.data(), list, counts);
    for (unsigned query = 0; query < kPacketCapacity; ++query) {
      std::size_t count = 3;
      for (const LeafOfWords& leaf : list) {
        LaneMask lanes = 0;
        for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
          lanes |= (words[leaf.words].reached[lane] >> query & 1U) << lane;
        }
        ASSERT_EQ(tried.lanes_of(words[leaf.words].reached.data(), query), lanes);
        count += static_cast<std::size_t>(std::popcount(lanes));
      }
      ASSERT_EQ(counts[query], count);
    }
  }
}

TEST_P(EveryJointPath, RowsAreWrittenToTheirLastIdAndNotBeyond) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 9U, 40U}) {
    std::vector<PerLane<QueryWord>> words(count);
    std::vector<Piece> pieces;
    std::vector<VertexId> leaf_begin{0};
    const auto add_leaf = [&] {
      const auto size = static_cast<VertexId>(1 + random.below(kLeafCapacity));
      leaf_begin.push_back(static_cast<VertexId>(leaf_begin.back() + size));
      return size;
    };
    for (std::size_t i = 0; i < count; ++i) {
      while (random.below(3) == 0) add_leaf();  // that no query has
      const auto leaf = static_cast<std::uint32_t>(leaf_begin.size() - 1);
      unsigned size = add_leaf();
      const bool is_run = random.below(2) == 0;
      while (is_run && random.below(2) == 0) add_leaf();
      words[i] = random_words();
      if (random.below(4) == 0) words[i].fill(~QueryWord{0});
      std::fill(words[i].begin() + size, words[i].end(), 0);
      pieces.push_back({{leaf, static_cast<std::uint32_t>(leaf_begin.size() - 1)},
                        is_run ? random_word() : 0,
                        is_run ? nullptr : words[i].data()});
    }
    const std::size_t vertices = leaf_begin.back();
    std::vector<VertexId> permutation(vertices + kLeafCapacity);
    for (VertexId& id : permutation) id = static_cast<VertexId>(random.bits() % 60000);
    for (unsigned query = 0; query < kPacketCapacity; ++query) {
      std::vector<VertexId> by_place;
      for (const auto& [leaves, queries, reached] : pieces) {
        const VertexId first = leaf_begin[leaves.begin];
        for (VertexId vertex = first; vertex < leaf_begin[leaves.end]; ++vertex) {
          const QueryWord word = reached == nullptr ? queries : reached[vertex - first];
          if ((word >> query & 1U) != 0) by_place.push_back(vertex);
        }
      }
      std::vector<VertexId> by_id;
      for (const VertexId vertex : by_place) by_id.push_back(permutation[vertex]);
      constexpr VertexId kUntouched = 60001;
      std::vector<VertexId> found(by_id.size() + 64, kUntouched);
      const auto row = std::span(found).first(by_id.size());
      const auto behind = std::span(found).subspan(by_id.size());
      tried.write_row(pieces, leaf_begin.data(), query, permutation.data(), row);
      ASSERT_TRUE(std::equal(row.begin(), row.end(), by_id.begin()));
      ASSERT_THAT(behind, testing::Each(kUntouched));
      tried.write_row(pieces, leaf_begin.data(), query, nullptr, row);
      ASSERT_TRUE(std::equal(row.begin(), row.end(), by_place.begin()));
      ASSERT_THAT(behind, testing::Each(kUntouched));
    }
  }
}

TEST_P(EveryJointPath, WordsArePushedOverEveryEdge) {
  for (std::size_t round = 0; round < 1000; ++round) {
    std::vector<CrossEdge> edges(random.below(60));
    const PerLane<QueryWord> reached = random_words();
    PerLane<QueryWord> pending = random_words();
    PerLane<QueryWord> expected = pending;
    for (CrossEdge& edge : edges) {
      edge = {static_cast<std::uint8_t>(random.below(32)), static_cast<std::uint8_t>(random.below(32))};
      expected[edge.to] |= reached[edge.from];
    }
    push_words(edges, reached, pending);
    ASSERT_EQ(pending, expected);
  }
}

std::string path_name(const testing::TestParamInfo<Isa>& info) { return name_of(info.param); }

INSTANTIATE_TEST_SUITE_P(All, EveryJointPath, testing::ValuesIn(available_isas()), path_name);

}  // namespace
}  // namespace meshhood::test
