// SPDX-License-Identifier: MIT
// Every readable mesh of the shared folder: built with few and with all levels, checked and queried.
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/each_shared_mesh.h"
#include "support/paper_bounds.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// The component of every vertex, named by its first vertex.
std::vector<VertexId> components(ReferenceSearcher& reference) {
  const std::size_t vertices = reference.adjacency().size();
  std::vector<VertexId> label(vertices, static_cast<VertexId>(-1));
  std::vector<VertexId> component;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (label[v] != static_cast<VertexId>(-1)) continue;
    reference.neighborhood(static_cast<VertexId>(v), std::numeric_limits<double>::infinity(), component);
    for (const VertexId w : component) label[w] = static_cast<VertexId>(v);
  }
  return label;
}

struct RealTally {
  std::size_t queries = 0;
  std::size_t exact = 0;  ///< vertices in all answers
  std::size_t extra = 0;  ///< in the paper's answers but not in the exact ones
};

/// A mesh too large for the oracle: compares the paper's answers with the reference, which other tests compare with it.
class RealMesh {
 public:
  RealMesh(const MeshView& mesh, const paper::BuildOptions& options, RealTally& tally)
      : mesh_(mesh),
        reference_(mesh),
        index_(paper::build(mesh, options)),
        searcher_(index_),
        component_(components(reference_)),
        bounds_(component_.size()),
        mean_edge_(mean_edge_length({mesh.positions, reference_.adjacency()})),
        tally_(tally) {
    EXPECT_THAT(index_.check(GraphView{mesh.positions, reference_.adjacency()}), testing::IsEmpty());
  }

  /// Queries of `queries` random vertices at a radius of `edges` mean edge lengths.
  void query(double edges, std::size_t queries, Random& random) {
    for (std::size_t i = 0; i < queries && !component_.empty(); ++i) {
      query(static_cast<VertexId>(random.below(component_.size())), edges * mean_edge_);
    }
  }

 private:
  void query(VertexId v, double radius) {
    reference_.neighborhood(v, radius, exact_);
    searcher_.neighborhood(v, radius, answer_);
    const auto inside = [&](VertexId w) {
      return component_[w] == component_[v] && distance(mesh_.positions, v, w) <= radius;
    };
    EXPECT_TRUE(bounds_.holds(exact_, answer_, inside)) << "vertex " << v << ", radius " << radius;
    EXPECT_EQ(searcher_.count(v, radius), answer_.size()) << "vertex " << v << ", radius " << radius;
    ++tally_.queries;
    tally_.exact += exact_.size();
    tally_.extra += answer_.size() - exact_.size();
  }

  MeshView mesh_;
  ReferenceSearcher reference_;
  paper::Index index_;
  paper::Searcher searcher_;
  std::vector<VertexId> component_;
  PaperBounds bounds_;
  double mean_edge_;
  RealTally& tally_;
  std::vector<VertexId> exact_;
  std::vector<VertexId> answer_;
};

class AllMeshes : public testing::TestWithParam<const char*> {};

TEST_P(AllMeshes, AreBuiltCheckedAndQueried) {
  MESHHOOD_NEED_SHARED_MESHES();
  std::size_t meshes = 0;
  std::size_t refused = 0;
  RealTally tally;
  for (const ManifestRow& row : read_manifest()) {
    if (!row.file.starts_with(GetParam())) continue;
    SCOPED_TRACE(row.file);
    const std::optional<io::Mesh> mesh = readable_mesh(row.file);
    refused += static_cast<std::size_t>(!mesh);
    if (!mesh) continue;
    ++meshes;
    for (const int levels : {5, paper::BuildOptions::kAllLevels}) {
      RealMesh real(mesh->view(), {.levels = levels, .discard = levels == 5 ? 2 : 0}, tally);
      Random random(1);
      for (const double edges : {0, 2, 5, 10, 20, 40, 65, 90, 1000}) real.query(edges, scaled(30, 2), random);
    }
  }
  std::printf("%s: %zu meshes, %zu refused by the readers, %zu queries, %zu vertices, %zu more by the paper\n",
              GetParam(), meshes, refused, tally.queries, tally.exact, tally.extra);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Folders, AllMeshes, shared_folders(), shared_folder_case);

}  // namespace
}  // namespace meshhood::test
