// SPDX-License-Identifier: MIT
// An answer is that of the oracle with each instruction set, and depends on index, vertex and radius alone, bit for
// bit: the ids in index order, their distances, ranges and count. The same queries are asked in many orders, after long
// histories, by several threads, one by one and in batches.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/batch.h"
#include "meshhood/k_nearest.h"
#include "meshhood/masks.h"
#include "meshhood/reorder.h"
#include "meshhood/search.h"
#include "meshhood/serialize.h"

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/oracle.h"
#include "support/scale.h"
#include "support/sheets.h"

namespace meshhood::test {
namespace {

struct Asked {
  VertexId v;
  double radius;
};

struct Answer {
  std::vector<VertexId> ids;
  std::vector<double> distances;

  friend bool operator==(const Answer&, const Answer&) = default;
};

Answer ask(Searcher& searcher, const Asked& asked) {
  Answer answer;
  searcher.neighborhood(asked.v, asked.radius, answer.ids, answer.distances);
  return answer;
}

/// The places of the caller's vertices in index order.
std::vector<std::size_t> places_of(const Index& index) {
  std::vector<std::size_t> places(index.vertex_count());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[index.permutation().empty() ? i : index.permutation()[i]] = i;
  }
  return places;
}

/// What the oracle finds, in index order.
Answer expected_answer(const Oracle& oracle, const std::vector<std::size_t>& places, const Asked& asked) {
  Answer answer;
  answer.ids = oracle.exact(asked.v, asked.radius);
  std::ranges::sort(answer.ids, {}, [&](VertexId w) { return places[w]; });
  for (const VertexId w : answer.ids) answer.distances.push_back(oracle.distance(asked.v, w));
  return answer;
}

/// Queries of a mesh with their answers.
struct Questions {
  std::vector<Asked> asked;
  std::vector<Answer> answers;

  Questions(const TestMesh& mesh, const Index& index, std::uint64_t seed, std::size_t vertices) {
    const Oracle oracle(mesh);
    const std::vector<std::size_t> places = places_of(index);
    Random random(seed);
    for (std::size_t i = 0; i < vertices; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) asked.push_back({v, radius});
    }
    for (const Asked& one : asked) answers.push_back(expected_answer(oracle, places, one));
  }

  /// Compares all kinds of answer of a searcher to the query `i`.
  void expect(Searcher& searcher, const Index& index, std::size_t i) const {
    ASSERT_EQ(ask(searcher, asked[i]), answers[i]) << "vertex " << asked[i].v << ", radius " << asked[i].radius;
    std::vector<VertexId> ids;
    searcher.neighborhood(asked[i].v, asked[i].radius, ids);
    ASSERT_EQ(ids, answers[i].ids);
    ASSERT_EQ(searcher.count(asked[i].v, asked[i].radius), ids.size());
    ids.clear();
    for (const VertexRange& range : searcher.ranges(asked[i].v, asked[i].radius)) {
      for (std::size_t at = range.begin; at < range.end; ++at) {
        ids.push_back(index.permutation().empty() ? static_cast<VertexId>(at) : index.permutation()[at]);
      }
    }
    ASSERT_EQ(ids, answers[i].ids) << "ranges are not in index order";
  }
};

/// The numbers of all queries in several orders.
std::vector<std::vector<std::uint32_t>> orders_of(std::size_t queries, Random& random) {
  std::vector<std::vector<std::uint32_t>> orders(1);
  for (std::uint32_t i = 0; i < queries; ++i) orders[0].push_back(i);
  orders.emplace_back(orders[0].rbegin(), orders[0].rend());
  for (int i = 0; i < 2; ++i) orders.push_back(random.permutation(queries));
  return orders;
}

/// Larger than those of families, so that queries are answered in every way.
TestMesh folded() { return make_folded_sheet(60, 0.5); }

class OneOrder : public testing::TestWithParam<Family> {
 protected:
  /// Calls `f(mesh, index, questions)` for some meshes of the family.
  template <class F>
  void for_each_mesh(F&& f) {
    for (std::uint64_t seed = 0; seed < scaled(6, 2); ++seed) {
      const TestMesh mesh = make_mesh(GetParam(), seed, seed == 0 ? 1500 : 300);
      if (mesh.size() == 0) continue;
      const Index index = build(mesh.view());
      f(mesh, index, Questions(mesh, index, seed, scaled(6, 2)));
      if (HasFatalFailure()) return;
    }
  }
};

TEST_P(OneOrder, OnManyMeshesOfAnySize) {
  constexpr std::size_t kVertices = 56;
  std::size_t queries = 0;
  for (std::uint64_t seed = 0; seed < scaled(152, 2); ++seed) {
    const std::size_t size = seed % 8 == 7 ? 1 + seed / 8 % 4 : std::min<std::size_t>(draw_size(seed), 1500);
    const TestMesh mesh = make_mesh(GetParam(), seed, size);
    if (mesh.size() == 0) continue;
    SCOPED_TRACE(mesh.name);
    const Index index = build(mesh.view());
    const Questions questions(mesh, index, seed, kVertices);
    std::vector<Searcher> searchers = searchers_of(index);
    for (std::size_t i = 0; i < questions.asked.size() && !HasFatalFailure(); ++i, ++queries) {
      questions.expect(searchers[i % searchers.size()], index, i);
    }
  }
  std::printf("%zu queries\n", queries);
}

TEST_P(OneOrder, OfFreshAndUsedSearchersWhateverWasAskedBefore) {
  std::size_t compared = 0;
  for_each_mesh([&](const TestMesh& mesh, const Index& index, const Questions& questions) {
    Random random(8);
    std::vector<Searcher> used = searchers_of(index);
    std::vector<VertexId> ids;
    for (Searcher& searcher : used) {
      for (std::size_t i = 0; i < scaled(300, 30); ++i) {
        searcher.neighborhood(static_cast<VertexId>(random.below(mesh.size())),
                              questions.asked[0].radius + random.uniform(0, 5), ids);
      }
      for (const auto& order : orders_of(questions.asked.size(), random)) {
        for (const std::uint32_t i : order) questions.expect(searcher, index, i);
        compared += order.size();
      }
    }
    for (std::size_t i = 0; i < questions.asked.size(); ++i) {
      Searcher fresh(index);
      ASSERT_EQ(ask(fresh, questions.asked[i]), questions.answers[i]);
    }
  });
  std::printf("%zu answers\n", compared);
}

TEST_P(OneOrder, OfBatchesStreamsAndRegions) {
  for_each_mesh([&](const TestMesh&, const Index& index, const Questions& questions) {
    std::vector<VertexId> vertices;
    std::vector<double> radii;
    for (const Asked& asked : questions.asked) {
      vertices.push_back(asked.v);
      radii.push_back(asked.radius);
    }
    const BatchQuery query{.vertices = vertices, .radius = radii};
    for (const unsigned threads : {1U, 3U}) {
      const Neighborhoods all = neighborhoods(index, query, {.distances = true}, {.threads = threads});
      for (const bool in_index_order : {false, true}) {
        std::size_t rows = 0;
        for_each_neighborhood(
            index, query,
            [&](const BatchRow& row) {
              ASSERT_THAT(row.ids, testing::ElementsAreArray(questions.answers[row.row].ids)) << "row " << row.row;
              ASSERT_THAT(row.distances, testing::ElementsAreArray(questions.answers[row.row].distances));
              ++rows;
            },
            {.distances = true, .in_index_order = in_index_order, .buffer_bytes = 1000}, {.threads = threads});
        ASSERT_EQ(rows, questions.asked.size());
      }
      for (std::size_t i = 0; i < questions.asked.size(); ++i) {
        const Answer found{{all.ids.begin() + static_cast<std::ptrdiff_t>(all.offsets[i]),
                            all.ids.begin() + static_cast<std::ptrdiff_t>(all.offsets[i + 1])},
                           {all.distances.begin() + static_cast<std::ptrdiff_t>(all.offsets[i]),
                            all.distances.begin() + static_cast<std::ptrdiff_t>(all.offsets[i + 1])}};
        ASSERT_EQ(found, questions.answers[i]) << "row " << i;
      }
    }
    const std::vector<std::uint8_t> none(index.vertex_count());
    const Index searched = masked(index, {.walls = none});
    std::array regions{Searcher(index), Searcher(searched)};
    for (std::size_t i = 0; i < questions.asked.size(); ++i) {
      const auto& [v, radius] = questions.asked[i];
      Answer found;
      regions[0].neighborhood(v, radius, found.ids, found.distances);
      ASSERT_EQ(found, questions.answers[i]) << "region " << i;
      // A filter that excludes nothing, by the other search.
      regions[1].neighborhood(v, radius, found.ids, found.distances);
      ASSERT_EQ(found, questions.answers[i]) << "masked region " << i;
      const Dab dab{v, radius};
      regions[0].stroke(std::span(&dab, 1), found.ids);
      ASSERT_EQ(found.ids, questions.answers[i].ids) << "stroke " << i;
    }
  });
}

TEST_P(OneOrder, OfNestedRadiiRingByRing) {
  std::size_t rings = 0;
  for_each_mesh([&](const TestMesh& mesh, const Index& index, const Questions& questions) {
    const std::vector<std::size_t> places = places_of(index);
    const Oracle oracle(mesh);
    const std::vector<std::uint8_t> none(index.vertex_count());
    const Index searched = masked(index, {.walls = none});
    std::array regions{Searcher(index), Searcher(searched)};
    std::vector<VertexId> ids;
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < questions.asked.size(); i += 7) {
      const VertexId v = questions.asked[i].v;
      std::vector<double> radii;
      for (const Asked& asked : questions.asked) radii.push_back(asked.radius);
      std::ranges::sort(radii);
      radii.erase(std::ranges::unique(radii).begin(), radii.end());
      for (Searcher& searcher : regions) {
        searcher.nested(v, radii, ids, counts);
        ASSERT_EQ(counts.size(), radii.size());
        std::vector<VertexId> before;
        for (std::size_t k = 0; k < radii.size(); ++k, ++rings) {
          const std::vector<VertexId> all = oracle.exact(v, radii[k]);
          std::vector<VertexId> ring;
          std::ranges::set_difference(all, before, std::back_inserter(ring));
          std::ranges::sort(ring, {}, [&](VertexId w) { return places[w]; });
          const auto begin = ids.begin() + static_cast<std::ptrdiff_t>(k == 0 ? 0 : counts[k - 1]);
          ASSERT_EQ(std::vector<VertexId>(begin, ids.begin() + static_cast<std::ptrdiff_t>(counts[k])), ring)
              << mesh.name << ": vertex " << v << ", radius " << radii[k];
          before = all;
        }
      }
    }
  });
  std::printf("%zu rings\n", rings);
}

INSTANTIATE_TEST_SUITE_P(Families, OneOrder, testing::ValuesIn(families()), family_name);

TEST(SearchOrder, IsThatOfTheIndexInEveryWayToAnswer) {
  const auto [mesh, index] = indexed(folded());
  const Questions questions(mesh, index, 3, scaled(40, 10));
  using Way = SearcherAccess::State::Way;
  std::map<Way, std::size_t> ways;
  for (Searcher& searcher : searchers_of(index)) {
    for (std::size_t i = 0; i < questions.asked.size(); ++i) {
      questions.expect(searcher, index, i);
      ++ways[SearcherAccess::state(searcher).way];
    }
  }
  for (const Way way : {Way::Alone, Way::LeafBfs, Way::Component}) EXPECT_GT(ways[way], 0U);
}

/// Two vertices at one place: each is as near to the other as to itself.
TEST(SearchOrder, OfPathsOfTheSameLengthIsThatOfTheIndex) {
  TestMesh mesh;
  for (const double x : {0.0, 0.0, 1.0, 2.0}) mesh.add_vertex(x, 0, 0);
  mesh.add_face({0, 1, 2});
  mesh.add_face({2, 3});
  const auto [given, index] = indexed(mesh.finish(false));
  Searcher searcher(index, Metric::Path);
  const std::vector<std::size_t> places = places_of(index);
  std::vector<VertexId> expected{0, 1, 2};
  if (places[1] < places[0]) std::swap(expected[0], expected[1]);
  for (const VertexId v : {0U, 1U}) {
    EXPECT_EQ(searcher.neighborhood(v, 1), expected);
    const std::vector<VertexId> seeds{v, v};
    EXPECT_EQ(searcher.neighborhood(Start(SpacePoint{0, 0, 0}, seeds), 1), expected);
    const std::vector<VertexId> one{v};
    const KNearest nearest = k_nearest(index, one, 3, {.metric = Metric::Path});
    EXPECT_EQ(std::vector(nearest.ids.begin(), nearest.ids.end()), expected);
    for (const std::size_t rows : {std::size_t{1}, std::size_t{8}}) {  // one by one, and together
      const std::vector<VertexId> list(rows, v);
      const Neighborhoods found = neighborhoods(index, {.vertices = list, .radius = 1, .metric = Metric::Path});
      EXPECT_EQ(std::vector(found.ids.begin(), found.ids.begin() + 3), expected);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
