// SPDX-License-Identifier: MIT
// The limits on vertices and edges, reached and exceeded by one (M6, M20 and F4 of docs/reliability.md). Ids of 16 bits
// let a small mesh reach them.
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/index_bytes.h"
#include "support/refusal.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

static_assert(sizeof(VertexId) == 2);
static_assert(kMaxVertices == 65'534);
static_assert(kMaxNeighbors == 65'535);

/// Vertices on a line; the first `sides` of them are the corners of one polygon.
TestMesh polygon_on_line(std::size_t vertices, std::size_t sides) {
  TestMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex(static_cast<double>(v), 0, 0);
  std::vector<std::uint32_t> corners(sides);
  std::iota(corners.begin(), corners.end(), 0U);
  mesh.add_face(corners);
  return mesh.finish(true);
}

TEST(NarrowIds, BuildsAtTheLimits) {
  const TestMesh mesh = polygon_on_line(kMaxVertices, kMaxNeighbors / 2);
  for (const int levels : {1, 5, paper::BuildOptions::kAllLevels}) {
    const paper::Index index = paper::build(mesh.view(), {.levels = levels});
    EXPECT_THAT(index.check(mesh.view()), IsEmpty());
    paper::Searcher searcher(index);
    EXPECT_EQ(searcher.count(0, kInfinity), kMaxNeighbors / 2);
    EXPECT_EQ(searcher.count(static_cast<VertexId>(kMaxVertices - 1), kInfinity), 1U);
    ReferenceSearcher reference(mesh.view());
    std::vector<VertexId> exact;
    reference.neighborhood(0, kInfinity, exact);
    EXPECT_EQ(exact.size(), kMaxNeighbors / 2);
  }
}

TEST(NarrowIds, RefusesOneVertexMore) {
  const TestMesh mesh = polygon_on_line(kMaxVertices + 1, 3);
  const char* const cause = "65535 vertices, but the limit is 65534";
  expect_refused(ErrorCode::TooLarge, cause, [&] { validate(mesh.view()); });
  expect_refused(ErrorCode::TooLarge, cause, [&] { return adjacency(mesh.view()); });
  expect_refused(ErrorCode::TooLarge, cause, [&] { return paper::build(mesh.view()); });
  expect_refused(ErrorCode::TooLarge, cause, [&] { const ReferenceSearcher searcher(mesh.view()); });
}

TEST(NarrowIds, RefusesOneCornerMore) {
  const TestMesh mesh = polygon_on_line(40'000, kMaxNeighbors / 2 + 1);
  const char* const cause = "32768 face corners, but the limit is 32767";
  EXPECT_NO_THROW(validate(mesh.view()));
  expect_refused(ErrorCode::TooLarge, cause, [&] { return adjacency(mesh.view()); });
  expect_refused(ErrorCode::TooLarge, cause, [&] { return paper::build(mesh.view()); });
}

TEST(NarrowIds, RefusesACornerThatNarrowingWouldHide) {
  TestMesh mesh = polygon_on_line(10, 3);
  mesh.add_face({0, 1, 65'536 + 2});
  expect_refused(ErrorCode::InvalidMesh, "face 1: corner 2 is vertex 65538, but the mesh has 10 vertices",
                 [&] { return adjacency(mesh.view()); });
}

TEST(NarrowIds, AnIndexIsSavedAndLoadedAtTheLimits) {
  const TestMesh mesh = polygon_on_line(kMaxVertices, kMaxNeighbors / 2);
  const std::vector<std::byte> exact = saved(build(mesh.view()));
  EXPECT_THAT(load(exact).check(mesh.view()), IsEmpty());
  EXPECT_EQ(saved(load(exact)), exact);
  const std::vector<std::byte> of_paper = saved(paper::build(mesh.view()));
  EXPECT_THAT(paper::load(of_paper).check(mesh.view()), IsEmpty());
  EXPECT_EQ(saved(paper::load(of_paper)), of_paper);
}

TEST(NarrowIds, AnIndexWithWideIdsIsRefused) {
  std::ifstream file(MESHHOOD_GOLDEN_DIR "/format3/float.mhi", std::ios::binary);
  const std::vector<char> wide{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  ASSERT_FALSE(wide.empty());
  expect_refused(ErrorCode::MalformedIndex, "header, byte 49: vertex ids of 32 bits, expected 16",
                 [&] { return load(std::as_bytes(std::span(wide))); });
}

}  // namespace
}  // namespace meshhood::test
