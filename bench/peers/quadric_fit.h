// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "meshhood/mesh.h"

namespace meshhood::bench {

/// The principal curvatures at a vertex of a mesh of triangles, from the quadric that fits its neighborhood best:
/// similar to libigl's principal_curvature, which uses the same ball, another mean of the normals, and the same kind of
/// least squares. The values are close, but not equal.
class QuadricFit {
 public:
  explicit QuadricFit(const MeshView& mesh)
      : points_(points_of(mesh)), normals_(points_.size(), Eigen::Vector3d::Zero()) {
    mesh.faces.for_each([this](std::size_t /*face*/, std::span<const VertexId> corners) { add_normal(corners); });
    for (Eigen::Vector3d& normal : normals_) normal.normalize();
  }

  /// Zero where there are too few vertices for a quadric. `neighborhood` holds the vertex itself.
  [[nodiscard]] std::array<double, 2> curvatures(VertexId v, std::span<const VertexId> neighborhood) const {
    if (neighborhood.size() < 6) return {0, 0};
    const Eigen::Matrix3d frame = frame_at(v, neighborhood);
    Eigen::MatrixXd terms(neighborhood.size(), 5);
    Eigen::VectorXd heights(neighborhood.size());
    for (std::size_t i = 0; i < neighborhood.size(); ++i) {
      const Eigen::Vector3d p = frame * (points_[neighborhood[i]] - points_[v]);
      const auto row = static_cast<Eigen::Index>(i);
      terms.row(row) << p.x() * p.x(), p.x() * p.y(), p.y() * p.y(), p.x(), p.y();
      heights[row] = p.z();
    }
    return curvatures_of(terms.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(heights));
  }

 private:
  static std::vector<Eigen::Vector3d> points_of(const MeshView& mesh) {
    return mesh.positions.visit([](const auto& xyz) {
      std::vector<Eigen::Vector3d> points;
      points.reserve(xyz.size());
      for (std::size_t v = 0; v < xyz.size(); ++v) points.emplace_back(xyz(v, 0), xyz(v, 1), xyz(v, 2));
      return points;
    });
  }

  /// Longer, the larger the triangle.
  void add_normal(std::span<const VertexId> corners) {
    const Eigen::Vector3d& origin = points_[corners[0]];
    const Eigen::Vector3d normal = (points_[corners[1]] - origin).cross(points_[corners[2]] - origin);
    for (const VertexId corner : corners.first(3)) normals_[corner] += normal;
  }

  /// Two directions along the surface, and the mean normal.
  [[nodiscard]] Eigen::Matrix3d frame_at(VertexId v, std::span<const VertexId> neighborhood) const {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const VertexId w : neighborhood) normal += normals_[w];
    if (normal.squaredNorm() == 0) normal = normals_[v];
    normal.normalize();
    const Eigen::Vector3d along = normal.unitOrthogonal();
    Eigen::Matrix3d frame;
    frame << along.transpose(), normal.cross(along).transpose(), normal.transpose();
    return frame;
  }

  /// Of z = a x^2 + b x y + c y^2 + d x + e y in the origin.
  static std::array<double, 2> curvatures_of(const Eigen::Vector<double, 5>& quadric) {
    const double d = quadric[3];
    const double e = quadric[4];
    Eigen::Matrix2d first;
    first << 1 + d * d, d * e, d * e, 1 + e * e;
    Eigen::Matrix2d second;
    second << 2 * quadric[0], quadric[1], quadric[1], 2 * quadric[2];
    second /= std::sqrt(1 + d * d + e * e);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(second, first, Eigen::EigenvaluesOnly);
    return {-solver.eigenvalues()[0], -solver.eigenvalues()[1]};
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace meshhood::bench
