// SPDX-License-Identifier: MIT
// A host program may flush denormal numbers to zero. That changes no answer unless coordinates or squared distances are
// denormal; even then every query ends. This is N4 of docs/reliability.md.
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
#include "support/sorted.h"

namespace meshhood::test {
namespace {

/// During its lifetime, denormal results and operands are zero.
class FlushDenormals {
 public:
  FlushDenormals() { _mm_setcsr(before_ | 0x8040U); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_ = _mm_getcsr();
};

struct ExpectedAnswer {
  VertexId v;
  double radius;
  std::vector<VertexId> expected;
};

/// Families whose answers depend on denormal numbers.
bool is_denormal(const Family& family) {
  constexpr std::array<std::string_view, 3> kDenormal{"tiny", "denormal", "vanishing"};
  return std::ranges::find(kDenormal, family.name) != kDenormal.end();
}

std::vector<ExpectedAnswer> expected_answers(const TestMesh& mesh, Random& random) {
  ReferenceSearcher reference(mesh.view());
  std::vector<ExpectedAnswer> expected;
  for (std::size_t i = 0; mesh.size() > 0 && i < 100; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = distance(mesh.positions_view(), v, static_cast<VertexId>(random.below(mesh.size())));
    std::vector<VertexId> ids;
    reference.neighborhood(v, radius, ids);
    expected.push_back({v, radius, sorted(ids)});
  }
  return expected;
}

/// The number of wrong answers with flushed denormals, of an index built in that mode.
std::size_t count_changed(const TestMesh& mesh, const std::vector<ExpectedAnswer>& expected) {
  const FlushDenormals flushed;
  const Index index = build(mesh.view());
  Searcher searcher(index);
  ReferenceSearcher reference(mesh.view());
  std::vector<VertexId> ids;
  std::size_t changed = 0;
  for (const ExpectedAnswer& item : expected) {
    searcher.neighborhood(item.v, item.radius, ids);
    changed += static_cast<std::size_t>(sorted(ids) != item.expected);
    reference.neighborhood(item.v, item.radius, ids);
    changed += static_cast<std::size_t>(sorted(ids) != item.expected);
  }
  return changed;
}

MESHHOOD_SUITE_OF_FAMILIES(FloatModes);

TEST_P(FloatModes, FlushingDenormalsChangesNoAnswer) {
  std::size_t queries = 0;
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 400);
    Random random(seed);
    const std::vector<ExpectedAnswer> expected = expected_answers(mesh, random);
    changed += count_changed(mesh, expected);
    queries += 2 * expected.size();
  }
  std::printf("%zu queries, %zu changed\n", queries, changed);
  if (!is_denormal(GetParam())) {
    EXPECT_EQ(changed, 0U);
  }
}

TEST(FlushedDenormals, AQueryOfRadiusZeroEnds) {
  const TestMesh mesh = make_grid(10, 10, false);
  const FlushDenormals flushed;
  EXPECT_EQ(exact_neighborhood(mesh.view(), 5, 0), std::vector<VertexId>{5});
}

}  // namespace
}  // namespace meshhood::test
