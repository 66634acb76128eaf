// SPDX-License-Identifier: MIT
// The paper's index, saved and loaded, is the same index. A changed file is refused; a forged one is refused or
// harmless.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "paper/same_index.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/forged_index.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

MESHHOOD_SUITE_OF_FAMILIES(SerializePaper);

TEST_P(SerializePaper, LoadingGivesTheSavedIndex) {
  for (const std::size_t vertices : {1U, 40U, 1500U}) {
    const TestMesh mesh = make_mesh(GetParam(), 5, vertices);
    SCOPED_TRACE(mesh.name);
    for (const int discard : {0, 2, 9}) {
      const paper::Index index = paper::build(mesh.view(), {.levels = 6, .discard = discard});
      const std::vector<std::byte> bytes = saved(index);
      const paper::Index loaded = paper::load(bytes);
      EXPECT_TRUE(same_index(loaded, index));
      EXPECT_EQ(saved(loaded), bytes);
      EXPECT_THAT(loaded.check(mesh.view()), testing::IsEmpty());
      EXPECT_EQ(read_header(bytes).kind, IndexKind::Paper);
      EXPECT_EQ(read_header(bytes).mesh, fingerprint(mesh.view()));
    }
  }
}

std::vector<std::byte> saved_grid() {
  Random random(6);
  TestMesh mesh = make_grid(11, 12, false);
  for (double& x : mesh.positions) x += random.uniform(-0.2, 0.2);
  return saved(paper::build(mesh.finish(true).view(), {.levels = 5, .discard = 1}));
}

std::string refusal_of(std::span<const std::byte> bytes) {
  return refusal_by([&] { return paper::load(bytes); });
}

void expect_harmless(const paper::Index& index, Random& random) {
  paper::Searcher searcher(index);
  std::vector<VertexId> ids;
  for (std::size_t query = 0; query < 32; ++query) {
    const auto v = static_cast<VertexId>(random.below(index.vertex_count()));
    const double radius = query == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 8);
    searcher.set_options({.radius_ratio = random.uniform(0.1, 20)});
    searcher.neighborhood(v, radius, ids);
    ASSERT_LE(ids.size(), index.vertex_count());
    ASSERT_TRUE(std::all_of(ids.begin(), ids.end(), [&](VertexId w) { return w < index.vertex_count(); }));
  }
}

TEST(SerializePaperFaults, EveryBitFlippedIsRefused) {
  const std::vector<std::byte> original = saved_grid();
  std::vector<std::byte> bytes = original;
  const std::size_t step = std::max<std::size_t>(1, 8 * bytes.size() / scaled(8 * bytes.size()));
  std::size_t flips = 0;
  std::size_t missed = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += step, ++flips) {
    bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    if (!refusal_of(bytes).starts_with(beginning_of_error(original, bit / 8))) ++missed;
    bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
  }
  std::printf("%zu bytes, %zu flips, %zu missed\n", bytes.size(), flips, missed);
  EXPECT_EQ(missed, 0U);
}

TEST(SerializePaperFaults, AForgedBitIsRefusedOrHarmless) {
  const std::vector<std::byte> original = saved_grid();
  std::vector<std::byte> bytes = original;
  const std::size_t step = std::max<std::size_t>(1, 8 * bytes.size() / scaled(8 * bytes.size()));
  std::size_t accepted = 0;
  Random random(7);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += step) {
    bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    seal(bytes);
    if (refusal_of(bytes).empty()) {
      expect_harmless(paper::load(bytes), random);
      ++accepted;
    }
    bytes = original;
  }
  std::printf("%zu forgeries accepted and searched\n", accepted);
  EXPECT_GT(accepted, 0U);
}

void expect_refused_after(const char* cause, const std::function<void(Forgery&)>& change) {
  expect_refused_after(cause, saved_grid(), change,
                       [](std::span<const std::byte> bytes) { return paper::load(bytes); });
}

TEST(SerializePaperFaults, EachRuleHasAForgeryThatItRefuses) {
  using paper::ClusterId;
  expect_refused_after("an exact index", [](Forgery& f) {
    f.header().kind = IndexKind::Exact;
    f.header().format = file::format_of(IndexKind::Exact);
  });
  expect_refused_after("expected ascending numbers", [](Forgery& f) { ++f.section<std::uint32_t>("levels")[0]; });
  expect_refused_after("section first_vertex", [](Forgery& f) { ++f.section<std::uint32_t>("levels")[1]; });
  expect_refused_after("vertex 132, expected", [](Forgery& f) { f.section<VertexId>("vertices")[3] = 132; });
  expect_refused_after("once",
                       [](Forgery& f) { f.section<VertexId>("vertices")[3] = f.section<VertexId>("vertices")[4]; });
  expect_refused_after("section positions",
                       [](Forgery& f) { f.section<float>("positions")[5] = std::numeric_limits<float>::quiet_NaN(); });
  expect_refused_after("cluster 2: range from", [](Forgery& f) { f.section<ClusterId>("first_vertex")[3] = 0; });
  expect_refused_after("section first_child 1", [](Forgery& f) { f.section<ClusterId>("first_child 1")[1] = 0; });
  expect_refused_after("begins with 1", [](Forgery& f) { f.section<ClusterId>("first_child 1")[0] = 1; });
  expect_refused_after("section first_child 1", [](Forgery& f) { --f.section<ClusterId>("first_child 1").back(); });
  expect_refused_after("a sphere whose center or radius is not finite",
                       [](Forgery& f) { f.section<Sphere<float>>("spheres 0")[1].radius = -1; });
  expect_refused_after("does not enclose", [](Forgery& f) { f.section<Sphere<float>>("spheres 1")[0].x += 9; });
  expect_refused_after("rows do not ascend", [](Forgery& f) { f.section<EdgeOffset>("sibling_rows 0")[1] = 100000; });
  expect_refused_after("rows do not run from 0", [](Forgery& f) { ++f.section<EdgeOffset>("sibling_rows 0").back(); });
  expect_refused_after("expected another of", [](Forgery& f) { f.section<ClusterId>("siblings 0")[0] = 4000000000U; });
  expect_refused_after("expected another of", [](Forgery& f) { f.section<ClusterId>("siblings 0")[0] = 0; });
  expect_refused_after("does not list it as a sibling", [](Forgery& f) {
    // Another cluster than the first sibling of the last, which it still precedes.
    const auto row = f.section<EdgeOffset>("sibling_rows 0");
    ClusterId& sibling = f.section<ClusterId>("siblings 0")[row[row.size() - 2]];
    sibling = sibling == 0 ? 1 : 0;
  });
}

TEST(SerializePaperFaults, EveryTruncationIsRefused) {
  const std::vector<std::byte> whole = saved_grid();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THAT(refusal_of(cut), testing::StartsWith("header, byte ")) << length;
  }
}

TEST(SerializePaperFaults, AnIndexOfTheOtherKindIsRefused) {
  const TestMesh mesh = make_grid(3, 3, false).finish(true);
  expect_refused(ErrorCode::MalformedIndex, "an exact index, expected a paper index",
                 [&] { return paper::load(saved(build(mesh.view()))); });
  expect_refused(ErrorCode::MalformedIndex, "a paper index, expected an exact index",
                 [&] { return load(saved(paper::build(mesh.view()))); });
}

}  // namespace
}  // namespace meshhood::test
