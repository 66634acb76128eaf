// SPDX-License-Identifier: MIT
// A host may have told its threads to take denormal numbers for zero. That changes no answer, unless coordinates, or
// squares of distances, are denormal themselves; then, too, every query ends.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <immintrin.h>

#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

/// Flushes denormal results to zero, and takes denormal operands for zero, as long as it lives.
class FlushDenormals {
 public:
  FlushDenormals() { _mm_setcsr(before_ | 0x8040U); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_ = _mm_getcsr();
};

struct Question {
  VertexId v;
  double radius;
  std::vector<VertexId> expected;
};

/// Families in which numbers are denormal that the answer depends on.
bool is_denormal(const Family& family) {
  constexpr std::array<std::string_view, 3> kDenormal{"tiny", "denormal", "vanishing"};
  return std::ranges::find(kDenormal, family.name) != kDenormal.end();
}

std::vector<VertexId> sorted(std::vector<VertexId> ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<Question> ask_before(const TestMesh& mesh, Random& random) {
  ReferenceSearcher reference(mesh.view());
  std::vector<Question> questions;
  for (std::size_t i = 0; mesh.size() > 0 && i < 100; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = distance(mesh.positions_view(), v, static_cast<VertexId>(random.below(mesh.size())));
    std::vector<VertexId> ids;
    reference.neighborhood(v, radius, ids);
    questions.push_back({v, radius, sorted(ids)});
  }
  return questions;
}

/// How many answers are not as expected where denormals are flushed, from an index built so.
std::size_t count_changed(const TestMesh& mesh, const std::vector<Question>& questions) {
  const FlushDenormals flushed;
  const Index index = build(mesh.view());
  Searcher searcher(index);
  ReferenceSearcher reference(mesh.view());
  std::vector<VertexId> ids;
  std::size_t changed = 0;
  for (const Question& question : questions) {
    searcher.neighborhood(question.v, question.radius, ids);
    changed += static_cast<std::size_t>(sorted(ids) != question.expected);
    reference.neighborhood(question.v, question.radius, ids);
    changed += static_cast<std::size_t>(sorted(ids) != question.expected);
  }
  return changed;
}

class FloatModes : public testing::TestWithParam<Family> {};

TEST_P(FloatModes, N4FlushingDenormalsChangesNoAnswer) {
  std::size_t queries = 0;
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 400);
    Random random(seed);
    const std::vector<Question> questions = ask_before(mesh, random);
    changed += count_changed(mesh, questions);
    queries += 2 * questions.size();
  }
  std::printf("%zu queries, %zu changed\n", queries, changed);
  if (!is_denormal(GetParam())) {
    EXPECT_EQ(changed, 0U);
  }
}

TEST(FlushedDenormals, N4AQueryOfRadiusZeroEnds) {
  const TestMesh mesh = make_grid(10, 10, false);
  const FlushDenormals flushed;
  EXPECT_EQ(exact_neighborhood(mesh.view(), 5, 0), std::vector<VertexId>{5});
}

INSTANTIATE_TEST_SUITE_P(All, FloatModes, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
