// SPDX-License-Identifier: MIT
// Compares answers with the oracle on all families of meshes: the exact answer is equal, and the paper's answer lies
// between the exact one and the vertices of the component in the ball.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/draw.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/oracle.h"
#include "support/paper_bounds.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

paper::BuildOptions draw_build_options(Random& random) {
  return {.levels = pick(random, {1, 2, 3, 5, paper::BuildOptions::kAllLevels}),
          .discard = pick(random, {0, 0, 1, 2, 70}),
          .fusion_growth = pick(random, {0.0, 1.0, 4.0, 16.0, 1e9})};
}

struct Tally {
  std::size_t meshes = 0;
  std::size_t indexes = 0;
  std::size_t queries = 0;
  std::size_t mismatches = 0;
};

/// One mesh, several indexes of it, and queries of all of them.
class Comparison {
 public:
  Comparison(const TestMesh& mesh, std::uint64_t seed, Tally& tally)
      : mesh_(mesh), oracle_(mesh), reference_(mesh.view()), bounds_(mesh.size()), random_(seed), tally_(tally) {
    for (int i = 0; i < 5; ++i) add_index(draw_build_options(random_));
    ++tally_.meshes;
  }

  void run(std::size_t vertices) {
    for (std::size_t i = 0; mesh_.size() > 0 && i < vertices; ++i) {
      const auto v = static_cast<std::uint32_t>(random_.below(mesh_.size()));
      for (const double radius : draw_radii(random_, oracle_, v)) query(v, radius);
    }
  }

 private:
  void add_index(const paper::BuildOptions& options) {
    indexes_.push_back(paper::build(mesh_.view(), options));
    searchers_.emplace_back(indexes_.back());
    EXPECT_THAT(indexes_.back().check(mesh_.view()), IsEmpty())
        << mesh_.name << ", levels " << options.levels << ", discard " << options.discard << ", growth "
        << options.fusion_growth;
    ++tally_.indexes;
  }

  void query(std::uint32_t v, double radius) {
    const std::vector<std::uint32_t> expected = oracle_.exact(v, radius);
    reference_.neighborhood(static_cast<VertexId>(v), radius, exact_);
    std::vector<VertexId> sorted = exact_;
    std::sort(sorted.begin(), sorted.end());
    expect(std::equal(sorted.begin(), sorted.end(), expected.begin(), expected.end()), "exact", v, radius);
    for (paper::Searcher& searcher : searchers_) query_paper(searcher, v, radius);
  }

  void query_paper(paper::Searcher& searcher, std::uint32_t v, double radius) {
    searcher.set_options({.radius_ratio = pick(random_, {0.1, 1.0, 3.0, 10.0, 100.0, 1e6})});
    searcher.neighborhood(static_cast<VertexId>(v), radius, answer_);
    const auto inside = [&](VertexId w) {
      return oracle_.distance(v, w) <= radius && oracle_.component(v) == oracle_.component(w);
    };
    expect(bounds_.holds(exact_, answer_, inside), "paper", v, radius);
    expect(searcher.count(static_cast<VertexId>(v), radius) == answer_.size(), "count", v, radius);
  }

  void expect(bool holds, const char* what, std::uint32_t v, double radius) {
    ++tally_.queries;
    if (holds) return;
    ++tally_.mismatches;
    ADD_FAILURE() << mesh_.name << ": " << what << " of vertex " << v << ", radius " << radius;
  }

  const TestMesh& mesh_;
  Oracle oracle_;
  ReferenceSearcher reference_;
  PaperBounds bounds_;
  Random random_;
  Tally& tally_;
  std::vector<paper::Index> indexes_;
  std::vector<paper::Searcher> searchers_;
  std::vector<VertexId> exact_;
  std::vector<VertexId> answer_;
};

MESHHOOD_SUITE_OF_FAMILIES(Differential);

TEST_P(Differential, AnswersAreThoseOfTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < scaled(150, 2) && tally.mismatches < 10; ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, draw_size(seed));
    Comparison(mesh, seed, tally).run(seed == 0 ? scaled(8) : 8);
  }
  std::printf("%s: %zu queries, %zu meshes, %zu indexes, %zu mismatches\n", std::string(GetParam().name).c_str(),
              tally.queries, tally.meshes, tally.indexes, tally.mismatches);
  EXPECT_EQ(tally.mismatches, 0U);
  EXPECT_GT(tally.meshes, 0U);
}

/// A second oracle, in integers, so that the same wrong distance cannot be in both. Distinct integers below 2^46 have
/// distinct square roots in double.
std::int64_t integer_squared_distance(const TestMesh& mesh, std::size_t v, std::size_t w) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto d =
        static_cast<std::int64_t>(mesh.positions[3 * v + i]) - static_cast<std::int64_t>(mesh.positions[3 * w + i]);
    sum += d * d;
  }
  return sum;
}

TEST(IntegerLattice, ExactAnswersEqualThoseInIntegers) {
  std::size_t queries = 0;
  for (std::uint64_t seed = 0; seed < scaled(200); ++seed) {
    Random random(seed);
    TestMesh mesh = make_grid(12, 12, false);
    const std::size_t size = pick<std::size_t>(random, {3, 100, 1 << 20});
    for (double& x : mesh.positions) x = static_cast<double>(random.below(size));
    mesh.finish(seed % 2 == 0);
    const Oracle oracle(mesh);
    std::vector<std::set<std::uint32_t>> neighbors;
    neighbors.reserve(mesh.size());
    for (std::size_t v = 0; v < mesh.size(); ++v) neighbors.push_back(oracle.neighbors(v));
    ReferenceSearcher reference(mesh.view());
    std::vector<VertexId> answer;
    for (int i = 0; i < 100; ++i, ++queries) {
      const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
      const std::int64_t square = integer_squared_distance(mesh, v, random.below(mesh.size()));
      const auto expected =
          connected(neighbors, v, [&](std::uint32_t w) { return integer_squared_distance(mesh, v, w) <= square; });
      reference.neighborhood(static_cast<VertexId>(v), std::sqrt(static_cast<double>(square)), answer);
      ASSERT_THAT(answer, testing::UnorderedElementsAreArray(expected.begin(), expected.end()))
          << "seed " << seed << ", vertex " << v << ", squared radius " << square;
    }
  }
  std::printf("%zu queries on integer lattices, 0 mismatches\n", queries);
}

}  // namespace
}  // namespace meshhood::test
