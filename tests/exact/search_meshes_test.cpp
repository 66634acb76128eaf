// SPDX-License-Identifier: MIT
// Exact answers on real meshes and on sheets that lie close together. The long run is tools/verify.
#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shapes/shapes.h"
#include "support/exact_answer.h"
#include "support/scale.h"
#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

/// About `vertices` vertices, spread evenly, at each of the radii in mean edges.
void query_spread(ExactAnswer& exact, std::size_t vertices, std::initializer_list<double> edges) {
  const double mean_edge = mean_edge_length(exact.graph());
  const std::size_t size = exact.index().vertex_count();
  const std::size_t step = std::max<std::size_t>(1, size / vertices);
  for (std::size_t v = 0; v < size; v += step) {
    for (const double radius : edges) exact.query_ids(static_cast<VertexId>(v), radius * mean_edge);
  }
}

void report(const char* name, const ExactAnswer& exact) {
  std::printf("%s: %zu vertices, %zu queries, %zu mismatches\n", name, exact.index().vertex_count(), exact.queries(),
              exact.mismatches());
  EXPECT_EQ(exact.mismatches(), 0U);
}

class RealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(RealMeshes, AnswersAreThoseOfTheReference) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam());
  ExactAnswer exact(mesh.view());
  query_spread(exact, scaled(4000, 200), {1, 2, 5, 10, 20});
  query_spread(exact, scaled(60, 6), {65});
  report(GetParam(), exact);
}

TEST_P(RealMeshes, IndexIsSoundAndTakesAtMost34BytesAVertex) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam(), {.precision = io::Precision::Float});
  const Index index = build(mesh.view());
  const double per_vertex = static_cast<double>(index.bytes().total()) / static_cast<double>(index.vertex_count());
  std::printf("%s: %.2f bytes a vertex\n", GetParam(), per_vertex);
  EXPECT_LE(per_vertex, 35);
  EXPECT_THAT(index.check(mesh.view()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_cat2.off", "paper/tosca_victoria0.off",
                                         "scan/cortex_left_41k.ply.zst", "paper/stanford_dragon_437k.ply.zst",
                                         "paper/head_skin_1m.ply.zst", "paper/mri_head_a_1m.ply.zst"),
                         shared_mesh_case);

TEST(Shapes, AnswersAreThoseOfTheReference) {
  for (const shapes::Kind& kind : shapes::kinds()) {
    const shapes::Shape shape = kind.make(scaled(60'000, 3000));
    ExactAnswer exact(shape.view());
    query_spread(exact, scaled(500, 50), {1, 2, 5, 10, 20, 40});
    report(std::string(kind.name).c_str(), exact);
  }
}

}  // namespace
}  // namespace meshhood::test
