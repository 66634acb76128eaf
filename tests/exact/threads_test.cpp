// SPDX-License-Identifier: MIT
// One index asked by many threads at once, in every way there is; and built by many.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <latch>
#include <limits>
#include <span>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/same_storage.h"
#include "support/sanitized.h"
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

/// A query, and what one thread alone was told.
struct Question {
  VertexId v;
  double radius;
  std::vector<VertexId> exact;
  std::vector<VertexId> paper;
};

std::vector<Question> ask_alone(const MeshView& mesh, const paper::Index& paper_index) {
  ReferenceSearcher reference(mesh);
  paper::Searcher paper(paper_index);
  Random random(11);
  std::vector<Question> questions;
  for (std::size_t i = 0; i < 300; ++i) {
    Question question{static_cast<VertexId>(random.below(mesh.positions.size())), random.uniform(0, 12), {}, {}};
    if (i % 50 == 0) question.radius = kInfinity;
    reference.neighborhood(question.v, question.radius, question.exact);
    paper.neighborhood(question.v, question.radius, question.paper);
    question.exact = sorted(question.exact);
    question.paper = sorted(question.paper);
    questions.push_back(question);
  }
  return questions;
}

/// What one of the threads does: its own searchers on the indexes of all.
class Asker {
 public:
  Asker(const Index& index, const paper::Index& paper_index)
      : index_(index), paper_index_(paper_index), searcher_(index), paper_(paper_index) {}

  /// One of the ways to ask, in turn. False where the answer is not that of `question`.
  bool ask(const Question& question, std::size_t way) {
    switch (way % 7) {
      case 0: searcher_.neighborhood(question.v, question.radius, ids_); return sorted(ids_) == question.exact;
      case 1: return searcher_.count(question.v, question.radius) == question.exact.size();
      case 2: return ids_of(searcher_.ranges(question.v, question.radius)) == question.exact;
      case 3:
        searcher_.neighborhood(question.v, question.radius, ids_, distances_);
        return sorted(ids_) == question.exact && distances_.size() == ids_.size();
      case 4: paper_.neighborhood(question.v, question.radius, ids_); return sorted(ids_) == question.paper;
      case 5: return paper_.count(question.v, question.radius) == question.paper.size();
      default: return batches_agree(question, way);
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

  bool batches_agree(const Question& question, std::size_t way) {
    const BatchQuery query{.vertices = std::span(&question.v, 1), .radius = question.radius};
    const BatchOptions options{.threads = 1 + static_cast<unsigned>(way % 2), .sorted = true};
    return neighborhoods(index_, query, options).ids == question.exact &&
           neighborhoods(paper_index_, query, options).ids == question.paper;
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
    const std::vector<Question> questions = ask_alone(mesh.view(), paper_index);
    std::latch start(kThreads);  // the first queries race with each other
    std::vector<std::thread> threads;
    threads.reserve(kThreads);
    for (std::size_t t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        Asker asker(index, paper_index);
        start.arrive_and_wait();
        for (std::size_t i = 0; i < queries; ++i) {
          const bool right = asker.ask(questions[(37 * t + i) % questions.size()], t + i);
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
  const TestMesh mesh = make_grid(250, 240, true).finish(true);
  const Index expected = build(mesh.view());
  std::thread other([&] {
    std::size_t reports = 0;
    const auto give_up = [&](std::size_t, std::size_t) { return ++reports < 2; };
    EXPECT_THROW(static_cast<void>(build(mesh.view(), {.threads = kThreads, .progress = give_up})), Error);
  });
  EXPECT_THAT(differences(build(mesh.view(), {.threads = kThreads}), expected), testing::IsEmpty());
  EXPECT_THAT(differences(reorder(mesh.view(), {.threads = kThreads}).index, reorder(mesh.view()).index),
              testing::IsEmpty());
  other.join();
}

// So many rows that every thread gets some.
TEST(Threads, ManyThreadsAnswerABatch) {
  const TestMesh mesh = make_grid(120, 100, false).finish(false);
  const Index index = build(mesh.view());
  const paper::Index paper_index = paper::build(mesh.view());
  const BatchQuery query{.vertices = {}, .radius = 3.5};
  const BatchOptions alone{.sorted = true};
  const BatchOptions many{.threads = kThreads, .sorted = true};
  EXPECT_EQ(neighborhoods(index, query, many).ids, neighborhoods(index, query, alone).ids);
  EXPECT_EQ(neighborhoods(paper_index, query, many).ids, neighborhoods(paper_index, query, alone).ids);
  EXPECT_EQ(neighborhood_sizes(index, query, many), neighborhood_sizes(index, query, alone));
}

}  // namespace
}  // namespace meshhood::test
