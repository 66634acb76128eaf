// SPDX-License-Identifier: MIT
// Many threads query one index at once, by every method; and many threads build one.
#include <atomic>
#include <cstdio>
#include <latch>
#include <span>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/indexed.h"
#include "support/same_storage.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kThreads = 8;
constexpr std::size_t kVertices = 3000;

/// A surface in one piece, on which balls are searched outward, and one of many sheets, on which they are flooded.
std::vector<TestMesh> meshes() {
  std::vector<TestMesh> result;
  result.push_back(make_grid(60, 50, false));
  TestMesh sheets;
  for (int sheet = 0; sheet < 5; ++sheet) {
    TestMesh next = make_grid(30, 20, true);
    for (std::size_t i = 2; i < next.positions.size(); i += 3) next.positions[i] = 0.6 * sheet;
    append(sheets, next);
  }
  result.push_back(sheets.finish(false));
  return result;
}

/// A query, and its answers on a single thread.
struct ExpectedAnswers {
  VertexId v;
  double radius;
  std::vector<VertexId> exact;
  std::vector<VertexId> paper;
};

std::vector<ExpectedAnswers> expected_answers(const MeshView& mesh, const paper::Index& paper_index) {
  ReferenceSearcher reference(mesh);
  paper::Searcher paper(paper_index);
  Random random(11);
  std::vector<ExpectedAnswers> result;
  for (std::size_t i = 0; i < 300; ++i) {
    ExpectedAnswers row{static_cast<VertexId>(random.below(mesh.positions.size())), random.uniform(0, 12), {}, {}};
    if (i % 50 == 0) row.radius = kInfinity;
    reference.neighborhood(row.v, row.radius, row.exact);
    paper.neighborhood(row.v, row.radius, row.paper);
    row.exact = sorted(row.exact);
    row.paper = sorted(row.paper);
    result.push_back(row);
  }
  return result;
}

/// The queries of one thread: it has its own searchers on the shared indexes.
class QueryThread {
 public:
  QueryThread(const Index& index, const paper::Index& paper_index)
      : index_(index), paper_index_(paper_index), searcher_(index), paper_(paper_index) {}

  /// Queries by one of the methods in turn. Returns whether the answer is that of `expected`.
  bool answers_correctly(const ExpectedAnswers& expected, std::size_t way) {
    switch (way % 7) {
      case 0: searcher_.neighborhood(expected.v, expected.radius, ids_); return sorted(ids_) == expected.exact;
      case 1: return searcher_.count(expected.v, expected.radius) == expected.exact.size();
      case 2: return ids_of(searcher_.ranges(expected.v, expected.radius)) == expected.exact;
      case 3:
        searcher_.neighborhood(expected.v, expected.radius, ids_, distances_);
        return sorted(ids_) == expected.exact && distances_.size() == ids_.size();
      case 4: paper_.neighborhood(expected.v, expected.radius, ids_); return sorted(ids_) == expected.paper;
      case 5: return paper_.count(expected.v, expected.radius) == expected.paper.size();
      default: return batches_agree(expected, way);
    }
  }

 private:
  std::vector<VertexId> ids_of(std::span<const VertexRange> ranges) {
    ids_.clear();
    for (const VertexRange& range : ranges) {
      const auto part = index_.permutation().subspan(range.begin, range.end - range.begin);
      ids_.insert(ids_.end(), part.begin(), part.end());
    }
    return sorted(ids_);
  }

  bool batches_agree(const ExpectedAnswers& expected, std::size_t way) {
    const BatchQuery query{.vertices = std::span(&expected.v, 1), .radius = expected.radius};
    const meshhood::Run run{.threads = 1 + static_cast<unsigned>(way % 2)};
    return neighborhoods(index_, query, {.sort = RowSort::Id}, run).ids == expected.exact &&
           neighborhoods(paper_index_, query, {.sort = RowSort::Id}, run).ids == expected.paper;
  }

  const Index& index_;
  const paper::Index& paper_index_;
  Searcher searcher_;
  paper::Searcher paper_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

TEST(Threads, ManyThreadsMaySearchOneIndexWithEveryMethod) {
  const std::size_t queries = scaled(100'000, kThreadSanitized ? 50'000 : 700);
  std::atomic<std::size_t> wrong = 0;
  for (const TestMesh& mesh : meshes()) {
    ASSERT_EQ(mesh.size(), kVertices);
    const Index index = build(mesh.view());
    const paper::Index paper_index = paper::build(mesh.view());
    const std::vector<ExpectedAnswers> expected = expected_answers(mesh.view(), paper_index);
    std::latch start(kThreads);  // the first queries race with each other
    std::vector<std::thread> threads;
    threads.reserve(kThreads);
    for (std::size_t t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        QueryThread own(index, paper_index);
        start.arrive_and_wait();
        for (std::size_t i = 0; i < queries; ++i) {
          const bool right = own.answers_correctly(expected[(37 * t + i) % expected.size()], t + i);
          if (!right) ++wrong;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(wrong, 0U);
  std::printf("%zu threads, %zu queries, %zu mismatches\n", kThreads, 2 * kThreads * queries, wrong.load());
}

// The mesh has more vertices than a thread takes at once. Two callers build from it, and one of them cancels.
TEST(Threads, ManyThreadsBuildTheSameIndex) {
  const auto [mesh, expected] = indexed(make_grid(250, 240, true).finish(true));
  std::thread other([&] {
    std::size_t reports = 0;
    const auto give_up = [&](std::size_t, std::size_t) { return ++reports < 2; };
    EXPECT_THROW(static_cast<void>(build(mesh.view(), {.threads = kThreads, .progress = give_up})), Error);
  });
  EXPECT_THAT(differences(build(mesh.view(), {.threads = kThreads}), expected), testing::IsEmpty());
  EXPECT_THAT(
      differences(reorder(mesh.view(), {.threads = kThreads}).index, reorder(mesh.view(), {.threads = 1}).index),
      testing::IsEmpty());
  other.join();
}

}  // namespace
}  // namespace meshhood::test
