// SPDX-License-Identifier: MIT
// The exact index against the oracle on random meshes of all families: ids, distances, counts and ranges, with each
// instruction set.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// One mesh, and queries of its index.
class SearchComparison {
 public:
  explicit SearchComparison(const TestMesh& mesh)
      : mesh_(mesh), oracle_(mesh), index_(build(mesh.view())), searchers_(searchers_of(index_)) {
    EXPECT_THAT(index_.check(mesh.view()), testing::IsEmpty()) << mesh.name;
  }

  /// The instruction sets in turn.
  void query(VertexId v, double radius) {
    Searcher& searcher = searchers_[queries_++ % searchers_.size()];
    const std::vector<std::uint32_t> expected = oracle_.exact(v, radius);
    searcher.neighborhood(v, radius, ids_, distances_);
    const bool right = has_right_distances(v) && is_right(ids_, expected) &&
                       searcher.count(v, radius) == expected.size() &&
                       is_right(ids_of(searcher.ranges(v, radius)), expected);
    EXPECT_TRUE(right) << mesh_.name << ": vertex " << v << ", radius " << radius;
    mismatches_ += static_cast<std::size_t>(!right);
  }

  [[nodiscard]] const Oracle& oracle() const { return oracle_; }
  [[nodiscard]] std::size_t queries() const { return queries_; }
  [[nodiscard]] std::size_t mismatches() const { return mismatches_; }

 private:
  static bool is_right(std::vector<VertexId> ids, const std::vector<std::uint32_t>& expected) {
    std::sort(ids.begin(), ids.end());
    return ids == expected;
  }

  [[nodiscard]] bool has_right_distances(VertexId v) const {
    bool right = distances_.size() == ids_.size();
    for (std::size_t i = 0; right && i < ids_.size(); ++i) right = distances_[i] == oracle_.distance(v, ids_[i]);
    return right;
  }

  [[nodiscard]] std::vector<VertexId> ids_of(std::span<const VertexRange> ranges) const {
    std::vector<VertexId> ids;
    for (const VertexRange& range : ranges) {
      EXPECT_LT(range.begin, range.end);
      for (VertexId i = range.begin; i < range.end; ++i) ids.push_back(index_.permutation()[i]);
    }
    return ids;
  }

  const TestMesh& mesh_;
  Oracle oracle_;
  Index index_;
  std::vector<Searcher> searchers_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
  std::size_t queries_ = 0;
  std::size_t mismatches_ = 0;
};

class SearchDifferential : public testing::TestWithParam<Family> {};

TEST_P(SearchDifferential, AnswersAreThoseOfTheOracle) {
  constexpr std::size_t kQueries = 1000;
  std::size_t meshes = 0;
  std::size_t queries = 0;
  std::size_t mismatches = 0;
  for (std::uint64_t seed = 0; seed < scaled(152, 2) && mismatches < 10; ++seed) {
    const std::size_t size = seed % 8 == 7 ? 1 + seed / 8 % 4 : std::min<std::size_t>(draw_size(seed), 1500);
    const TestMesh mesh = make_mesh(GetParam(), seed, size);
    SearchComparison comparison(mesh);
    Random random(seed);
    while (mesh.size() > 0 && comparison.queries() < kQueries) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, comparison.oracle(), v)) comparison.query(v, radius);
    }
    ++meshes;
    queries += comparison.queries();
    mismatches += comparison.mismatches();
  }
  std::printf("%s: %zu queries, %zu meshes, %zu mismatches\n", std::string(GetParam().name).c_str(), queries, meshes,
              mismatches);
  EXPECT_EQ(mismatches, 0U);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchDifferential, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
