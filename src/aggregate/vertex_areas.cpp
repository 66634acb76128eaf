// SPDX-License-Identifier: MIT
#include <span>

#include "meshhood/aggregate.h"

#include "base/frame.h"
#include "base/vector.h"

namespace meshhood {
namespace {

/// Half the sum of the cross products of consecutive corners, seen from the first: Newell's vector area. In the unit of
/// the frame, where nothing overflows.
template <class Real, class Corner>
double frame_area(const StridedPositions<Real>& xyz, const Frame& frame, std::span<const Corner> corners) {
  const auto corner = [&](std::size_t i) { return frame.to_frame(point(xyz, static_cast<std::size_t>(corners[i]))); };
  Point sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum = sum + cross(corner(i) - corner(0), corner(i + 1) - corner(0));
  }
  return length(sum) / 2;
}

}  // namespace

std::vector<double> vertex_areas(const MeshView& mesh) {
  validate(mesh);
  const Frame frame = make_frame(mesh.positions);
  std::vector<double> areas(mesh.positions.size());
  mesh.positions.visit([&](const auto& xyz) {
    mesh.faces.for_each([&](std::size_t /*face*/, auto corners) {
      if (corners.size() < 3) return;
      const double share = frame_area(xyz, frame, corners) / static_cast<double>(corners.size());
      for (const auto corner : corners) areas[static_cast<std::size_t>(corner)] += share;
    });
  });
  for (double& area : areas) area = (area / frame.scale) / frame.scale;
  return areas;
}

}  // namespace meshhood
