// SPDX-License-Identifier: MIT
// Files of each released format can be read and searched, and an index built today gives the same bytes. All compilers
// and presets run this test, so they agree byte for byte.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/same_index.h"
#include "shapes.h"
#include "shared/checksum.h"
#include "support/exact_answer.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

std::vector<std::byte> golden_file(const std::string& folder, const std::string& name) {
  std::ifstream file(MESHHOOD_GOLDEN_DIR "/" + folder + "/" + name + ".mhi", std::ios::binary);
  const std::vector<char> content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(content));
  return {bytes.begin(), bytes.end()};
}

/// Compares the answers with breadth-first search, for each instruction set of this processor.
std::size_t expect_right_answers(const Index& index) {
  const GraphData mesh = extract_graph(index);
  ReferenceSearcher reference(mesh.view());
  std::vector<Searcher> searchers = searchers_of(index);
  std::vector<VertexId> expected;
  std::vector<VertexId> ids;
  Random random(5);
  std::size_t queries = 0;
  for (; queries < 300 && index.vertex_count() > 0; ++queries) {
    const auto v = static_cast<VertexId>(random.below(index.vertex_count()));
    const double radius = queries % 50 == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 9);
    reference.neighborhood(v, radius, expected);
    searchers[queries % searchers.size()].neighborhood(v, radius, ids);
    EXPECT_THAT(ids, testing::UnorderedElementsAreArray(expected)) << "vertex " << v << ", radius " << radius;
  }
  return queries;
}

/// Exact indexes and paper indexes have formats of their own.
std::string folder_of(const GoldenShape& shape) { return shape.index == GoldenIndex::Paper ? "format1" : "format3"; }

/// Where numbers have another order of bytes, index files are refused, and no other test can run.
class Golden : public testing::Test {
 protected:
  void SetUp() override {
    if constexpr (std::endian::native != std::endian::little) {
      const std::vector<std::byte> bytes = golden_file("format3", "float");
      expect_refused(ErrorCode::MalformedIndex, "little-endian machines only", [&] { return load(bytes); });
      GTEST_SKIP() << "index files are those of little-endian machines";
    }
  }
};

TEST_F(Golden, ExactFilesOfEarlierFormatsAreRefusedWithTheAdviceToBuildAgain) {
  for (const std::string format : {"1", "2"}) {
    const std::vector<std::byte> bytes = golden_file("format" + format, "float");
    expect_refused(ErrorCode::MalformedIndex,
                   "format " + format + ", but this version reads format 3: build the index again",
                   [&] { return load(bytes); });
  }
}

TEST_F(Golden, FilesOfFormat3CanBeReadAndSearched) {
  for (const GoldenShape& shape : golden_shapes()) {
    if (shape.index == GoldenIndex::Paper) continue;
    SCOPED_TRACE(shape.name);
    const std::vector<std::byte> bytes = golden_file("format3", shape.name);
    ASSERT_EQ(read_header(bytes).format, 3U);
    const Index index = load(bytes);
    ASSERT_EQ(index.vertex_count(), shape.mesh.size());
    if (shape.index == GoldenIndex::Exact) {
      EXPECT_EQ(read_header(bytes).mesh, fingerprint(shape.mesh.view()));
      EXPECT_THAT(index.check(shape.mesh.view()), testing::IsEmpty());
    }
    std::printf("%s: %zu bytes, %zu queries\n", shape.name.c_str(), bytes.size(), expect_right_answers(index));
  }
}

TEST_F(Golden, PaperFilesOfFormat1EqualTheIndexBuiltToday) {
  for (const GoldenShape& shape : golden_shapes()) {
    if (shape.index != GoldenIndex::Paper) continue;
    SCOPED_TRACE(shape.name);
    const std::vector<std::byte> bytes = golden_file("format1", shape.name);
    ASSERT_EQ(read_header(bytes).format, 1U);
    EXPECT_EQ(read_header(bytes).mesh, fingerprint(shape.mesh.view()));
    const paper::Index index = paper::load(bytes);
    EXPECT_TRUE(same_index(index, paper::build(shape.mesh.view())));
    EXPECT_THAT(index.check(shape.mesh.view()), testing::IsEmpty());
    std::printf("%s: %zu bytes\n", shape.name.c_str(), bytes.size());
  }
}

TEST_F(Golden, BytesBuiltTodayAreThoseOfTheFormat) {
  for (const GoldenShape& shape : golden_shapes()) {
    const std::vector<std::byte> expected = golden_file(folder_of(shape), shape.name);
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      EXPECT_TRUE(golden_bytes(shape, threads) == expected) << shape.name << ", " << threads << " threads";
    }
  }
}

/// Indexes too large to commit: with several levels, and more vertices than one thread processes at once.
struct LargeIndex {
  GoldenShape shape;
  std::string digest;  ///< XXH3 (128 bits) of its bytes
};

std::vector<LargeIndex> large_indexes() {
  return {
      {{"large float", wavy_grids(200, false, true)}, "9e4a63e36a0acc015e4edf3f5c90bfba"},
      {{"large double", wavy_grids(190, true, false)}, "7f90ab53129ec85a210febbf297bec75"},
      {{"large reordered", wavy_grids(180, true, true), GoldenIndex::Reordered}, "b5244c8b5e89f4e13d6953183c4fdb23"},
      {{"large paper", wavy_grids(200, false, true), GoldenIndex::Paper}, "1efa9731acbfa2ff8e3b9e4586fb8958"},
      {{"large paper double", wavy_grids(190, true, false), GoldenIndex::Paper}, "e72fe30f0da96d3831f16d2b7b52da6a"}};
}

TEST_F(Golden, BytesOfLargeIndexesBuiltTodayAreThoseOfTheFormat) {
  for (const auto& [shape, digest] : large_indexes()) {
    for (const unsigned threads : {1U, 8U}) {
      if (threads > 1 && shape.index == GoldenIndex::Paper) continue;
      const std::vector<std::byte> bytes = golden_bytes(shape, threads);
      EXPECT_EQ(to_text(wide_checksum({bytes})), digest) << shape.name << ", " << threads << " threads";
      if (threads == 1)
        std::printf("%s: %zu vertices, %zu bytes\n", shape.name.c_str(), shape.mesh.size(), bytes.size());
    }
  }
}

/// Digests of the exact index and of the paper's index, for graphs that are unlike a surface: those of the families
/// that are made without functions that differ between C libraries.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kOddMeshes{{
    {"star", "2a9b1d44590b63c8f61ca64ee0b4332f"},
    {"comb", "5ed2275210faee3e7e2890670e2dfec1"},
    {"clique", "df078a822a429b4967b978a857e3389b"},
    {"soup", "9f3aa2330fed70dd08e2fcf9f5cba01a"},
    {"shells", "7998f570d7b0e1352ab578de6dc47cd0"},
    {"isolated vertices", "1b512963b7665a5e7a30a8e1e67b06e7"},
    {"random faces", "f0b8798d7e1f606fc5eba257003299e6"},
}};

TEST_F(Golden, BytesOfIndexesOfOddMeshesBuiltTodayAreThoseOfTheFormat) {
  for (const auto& [name, digest] : kOddMeshes) {
    const auto family = std::ranges::find(trap_families(), name, &Family::name);
    const TestMesh mesh = make_mesh(*family, 3, 20000);
    const std::vector<std::byte> exact = saved(build(mesh.view()));
    EXPECT_EQ(to_text(wide_checksum({exact, saved(paper::build(mesh.view()))})), digest) << mesh.name;
  }
}

}  // namespace
}  // namespace meshhood::test
