// SPDX-License-Identifier: MIT
// Matrices of Eigen, as those of libigl, read in place: no copy of V and F is made.
#include <cstdio>

#include <Eigen/Core>
#include <meshhood/eigen.h>
#include <meshhood/meshhood.h>

namespace {

// [readme]
/// The number of vertices in the neighborhood of `v`.
std::size_t neighbors(const Eigen::MatrixXd& V, const Eigen::MatrixXi& F, meshhood::VertexId v, double radius) {
  const auto index = meshhood::build(meshhood::mesh_view(V, F));
  meshhood::Searcher searcher(index);
  return searcher.count(v, radius);
}
// [readme]

}  // namespace

int main() {
  Eigen::MatrixXd V(4, 3);
  V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  Eigen::MatrixXi F(2, 3);
  F << 0, 1, 2, 1, 3, 2;
  const std::size_t found = neighbors(V, F, 0, 1.0);
  std::printf("within 1 of vertex 0: %zu of 4 vertices\n", found);
  return found == 3 ? 0 : 1;
}
