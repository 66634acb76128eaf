// SPDX-License-Identifier: MIT
// Batches on real meshes, on shapes that are difficult for a search, and at every scale: whole leaves at many radii,
// compared with the reference. The long run is tools/verify.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "shapes/shapes.h"
#include "support/families.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

/// The mean length of the edges, or 1 if there are none.
double edge_length(const GraphView& graph) { return graph.adjacency.neighbors.empty() ? 1 : mean_edge_length(graph); }

/// Compares a batch over some leaves of a mesh with the reference.
class LeafRows {
 public:
  /// About `rows` vertices, in leaves spread evenly.
  LeafRows(const MeshView& mesh, std::size_t rows)
      : reference_(mesh), index_(build(mesh)), edge_(edge_length({mesh.positions, reference_.adjacency()})) {
    const std::span<const VertexId> starts = index_.leaf_starts();
    const std::size_t step = std::max<std::size_t>(1, index_.vertex_count() / rows);
    for (std::size_t leaf = 0; leaf + 1 < starts.size(); leaf += step) {
      for (std::size_t i = starts[leaf]; i < starts[leaf + 1]; ++i) vertices_.push_back(index_.permutation()[i]);
    }
  }

  void query(std::initializer_list<double> edges) {
    for (const double radius : edges) query(std::vector<double>(vertices_.size(), radius * edge_));
  }

  /// A radius of its own for each row, up to `edges`.
  void query_any(double edges, Random& random) {
    std::vector<double> radii(vertices_.size());
    for (double& radius : radii) radius = random.uniform(0, edges) * edge_;
    query(radii);
  }

  void report(const std::string& name) const {
    std::printf("%s: %zu vertices, %zu rows, %zu mismatches\n", name.c_str(), index_.vertex_count(), rows_,
                mismatches_);
    EXPECT_EQ(mismatches_, 0U);
    EXPECT_GT(rows_, 0U);
  }

 private:
  void query(const std::vector<double>& radii) {
    const std::vector<std::uint64_t> sizes = counts(index_, {.vertices = vertices_, .radius = radii});
    for_each_neighborhood(index_, {.vertices = vertices_, .radius = radii},
                          [&](const BatchRow& row) {
                            reference_.neighborhood(vertices_[row.row], radii[row.row], expected_);
                            std::sort(expected_.begin(), expected_.end());
                            const bool same =
                                std::equal(row.ids.begin(), row.ids.end(), expected_.begin(), expected_.end());
                            mismatches_ += static_cast<std::size_t>(!same || sizes[row.row] != expected_.size());
                            ++rows_;
                          },
                          {.sorted = true, .in_index_order = true}, {.threads = 2});
  }

  ReferenceSearcher reference_;
  Index index_;
  double edge_;
  std::vector<VertexId> vertices_;
  std::vector<VertexId> expected_;
  std::size_t rows_ = 0;
  std::size_t mismatches_ = 0;
};

class JointMeshes : public testing::TestWithParam<const char*> {};

TEST_P(JointMeshes, RowsAreThoseOfTheReference) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam());
  LeafRows rows(mesh.view(), scaled(3000, 200));
  Random random(1);
  rows.query({0, 0.5, 1, 2, 3, 5, 10, 20});
  rows.query_any(12, random);
  rows.report(GetParam());
  LeafRows few(mesh.view(), scaled(60, 30));
  few.query({65});
  few.report(std::string(GetParam()) + ", large radius");
}

INSTANTIATE_TEST_SUITE_P(Meshes, JointMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_cat2.off", "paper/tosca_victoria0.off",
                                         "scan/cortex_left_41k.ply.zst", "scan/dragon_res4.ply",
                                         "paper/mri_head_a_1m.ply.zst"),
                         shared_mesh_case);

TEST(JointShapes, RowsAreThoseOfTheReference) {
  for (const shapes::Kind& kind : shapes::kinds()) {
    const shapes::Shape shape = kind.make(scaled(100'000, 3000));
    LeafRows rows(shape.view(), scaled(120, 60));
    Random random(2);
    rows.query({0, 1, 3, 10, 40, kInfinity});
    rows.query_any(10, random);
    rows.report(std::string(kind.name));
  }
}

TEST(JointScales, RowsAreThoseOfTheReference) {
  for (const double scale : {1e-30, 1e-20, 1.0, 1e20, 1e30}) {
    for (const bool single : {false, true}) {
      TestMesh mesh = bumpy_grid(40);
      for (double& x : mesh.positions) x *= scale;
      mesh.finish(single);
      LeafRows rows(mesh.view(), mesh.size());
      Random random(3);
      rows.query({0.5, 2, 7, 25});
      rows.query_any(9, random);
      rows.report("scale " + std::to_string(std::log10(scale)) + (single ? ", float" : ", double"));
    }
  }
}

}  // namespace
}  // namespace meshhood::test
