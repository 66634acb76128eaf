// SPDX-License-Identifier: MIT
#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"

#include "base/frame.h"
#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

/// In the unit of the frame, where nothing overflows.
template <class Real>
double frame_area(const StridedPositions<Real>& xyz, const Frame& frame, std::span<const VertexId> corners) {
  const auto corner = [&](std::size_t i) { return frame.to_frame(point(xyz, corners[i])); };
  return length(doubled_vector_area(corners.size(), corner)) / 2;
}

}  // namespace

std::vector<double> vertex_areas(const MeshView& mesh) {
  validate(mesh);
  const Frame frame = make_frame(mesh.positions);
  std::vector<double> areas(mesh.positions.size());
  mesh.positions.visit([&](const auto& xyz) {
    mesh.faces.for_each([&](std::size_t /*face*/, std::span<const VertexId> corners) {
      if (corners.size() < 3) return;
      const double share = frame_area(xyz, frame, corners) / static_cast<double>(corners.size());
      for (const VertexId corner : corners) areas[corner] += share;
    });
  });
  for (double& area : areas) area = (area / frame.scale) / frame.scale;
  return areas;
}

}  // namespace meshhood::inline v0_1
