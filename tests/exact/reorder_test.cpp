// SPDX-License-Identifier: MIT
// A reordered mesh is the same mesh, its index gives the same answers, and the two share one copy of the positions.
#include "meshhood/reorder.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/search.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/same_storage.h"
#include "support/shared_meshes.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

void expect_same_positions(const ReorderedMesh& reordered, const MeshView& mesh) {
  ASSERT_EQ(reordered.view().positions.size(), mesh.positions.size());
  reordered.view().positions.visit([&](const auto& now) {
    mesh.positions.visit([&](const auto& before) {
      for (std::size_t i = 0; i < 3 * now.size(); ++i) {
        const std::size_t v = reordered.permutation[i / 3];
        ASSERT_EQ(static_cast<double>(now(i / 3, i % 3)), static_cast<double>(before(v, i % 3)));
      }
    });
  });
}

/// Every face is a face of the mesh with its corners in the same order; faces ascend by their first vertex.
void expect_same_faces(const ReorderedMesh& reordered, const TestMesh& mesh) {
  std::vector<bool> seen(mesh.face_count());
  ASSERT_EQ(reordered.view().faces.size(), mesh.face_count());
  std::uint32_t first = 0;
  reordered.view().faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    const std::uint32_t old = reordered.face_permutation[face];
    EXPECT_FALSE(seen[old]);
    seen[old] = true;
    std::vector<std::uint32_t> given;
    for (const VertexId corner : corners) given.push_back(reordered.permutation[corner]);
    EXPECT_THAT(given, testing::ElementsAreArray(mesh.face(old)));
    if (corners.empty()) return;
    const VertexId least = *std::min_element(corners.begin(), corners.end());
    EXPECT_GE(least, first);
    first = least;
  });
}

std::size_t expect_same_answers(const ReorderedMesh& reordered, const Index& index, const MeshView& mesh) {
  Searcher now(reordered.index);
  Searcher before(index);
  std::vector<VertexId> ids;
  std::vector<VertexId> expected;
  std::vector<double> distances;
  Random random(2);
  std::size_t queries = 0;
  for (; queries < 60 && mesh.positions.size() > 0; ++queries) {
    const auto v = static_cast<VertexId>(random.below(mesh.positions.size()));
    const VertexId old = reordered.permutation[v];
    const auto other = static_cast<VertexId>(random.below(mesh.positions.size()));
    const double radius = queries % 10 == 0 ? std::numeric_limits<double>::infinity()
                                            : distance(mesh.positions, old, other) * (queries % 3 == 0 ? 1 : 0.3);
    now.neighborhood(v, radius, ids, distances);
    before.neighborhood(old, radius, expected);
    EXPECT_TRUE(std::ranges::is_sorted(ids)) << "index order";
    for (std::size_t i = 0; i < ids.size(); ++i) {
      EXPECT_EQ(distances[i], distance(reordered.view().positions, v, ids[i]));
      ids[i] = reordered.permutation[ids[i]];
    }
    EXPECT_EQ(sorted(ids), sorted(expected)) << "vertex " << v << ", radius " << radius;
    EXPECT_EQ(now.count(v, radius), expected.size());
  }
  return queries;
}

MESHHOOD_SUITE_OF_FAMILIES(ReorderedFamilies);

TEST_P(ReorderedFamilies, AnswersEqualThoseOfAnIndexInTheCallersOrder) {
  std::size_t queries = 0;
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 7, vertices);
    SCOPED_TRACE(mesh.name);
    const ReorderedMesh reordered = reorder(mesh.view());
    validate(reordered.view());
    EXPECT_THAT(reordered.index.check(reordered.view()), IsEmpty());
    EXPECT_THAT(reordered.index.permutation(), IsEmpty());
    const Index index = build(mesh.view());
    EXPECT_THAT(reordered.permutation, testing::ElementsAreArray(index.permutation()));
    expect_same_positions(reordered, mesh.view());
    expect_same_faces(reordered, mesh);
    queries += expect_same_answers(reordered, index, mesh.view());
  }
  std::printf("%s: %zu queries\n", std::string(GetParam().name).c_str(), queries);
}

TEST(Reorder, KeepsTrianglesAsTriangles) {
  const std::vector<float> xyz(9, 0.0F);
  const std::vector<std::uint32_t> corners{2, 1, 0};
  const ReorderedMesh mesh = reorder({xyz, FacesView::triangles(corners)});
  EXPECT_TRUE(mesh.view().faces.are_triangles());
  EXPECT_EQ(mesh.view().faces.size(), 1U);
}

TEST(Reorder, IsTheSameForAnyNumberOfThreads) {
  const TestMesh mesh = make_grid(150, 150, false).finish(true);
  const ReorderedMesh expected = reorder(mesh.view(), {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    const ReorderedMesh other = reorder(mesh.view(), {.threads = threads});
    EXPECT_THAT(differences(other.index, expected.index), IsEmpty());
    EXPECT_EQ(other.permutation, expected.permutation);
    EXPECT_EQ(other.corners, expected.corners);
  }
}

TEST(Reorder, CanBeCancelled) {
  const TestMesh mesh = make_grid(10, 10, true).finish(true);
  const auto at_the_end = [](std::size_t done, std::size_t total) { return done < total; };
  expect_refused(ErrorCode::Cancelled, "cancelled", [&] { return reorder(mesh.view(), {.progress = at_the_end}); });
}

TEST(Reorder, TakesTwentyBytesAVertexBesidesThePositions) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh("paper/head_skin_1m.ply.zst");
  const ReorderedMesh reordered = reorder(mesh.view(), {.threads = 2});
  const IndexBytes bytes = reordered.index.bytes();
  const auto vertices = static_cast<double>(reordered.permutation.size());
  const double a_vertex = static_cast<double>(bytes.total() - bytes.positions) / vertices;
  std::printf("%.0f vertices, %.2f bytes each besides the positions\n", vertices, a_vertex);
  EXPECT_LE(a_vertex, 20);
}

}  // namespace
}  // namespace meshhood::test
