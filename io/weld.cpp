// SPDX-License-Identifier: MIT
#include "io/weld.h"

#include <cmath>
#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/welder.h"

namespace meshhood::inline v0_1::io {
namespace {

void check_eps(double eps) {
  if (eps >= 0 && std::isfinite(eps)) return;
  raise(ErrorCode::InvalidOption, fmt::format("eps is {}, expected a finite number >= 0", eps));
}

/// Fills `kept` with the positions of the kept vertices. Returns the place of each vertex among these.
template <class Real>
std::vector<std::uint32_t> weld_into(std::vector<Real>& kept, const StridedPositions<Real>& xyz, double eps) {
  std::vector<std::uint32_t> ids;
  ids.reserve(xyz.size());
  Welder<Real> welder(kept, ids, "weld", eps);
  if (eps > 0) welder.expect(xyz.size());  // the cells of a growing table would be computed again
  for (std::size_t v = 0; v < xyz.size(); ++v) welder.append({xyz(v, 0), xyz(v, 1), xyz(v, 2)});
  return ids;
}

}  // namespace

WeldedMesh weld(const MeshView& mesh, double eps) {
  check_eps(eps);
  validate(mesh);
  WeldedMesh welded;
  welded.ids = mesh.positions.visit([&]<class Real>(const StridedPositions<Real>& xyz) {
    return weld_into(welded.positions.emplace<std::vector<Real>>(), xyz, eps);
  });
  welded.corners.reserve(mesh.faces.corner_count());
  if (!mesh.faces.are_triangles()) {
    welded.offsets.reserve(mesh.faces.size() + 1);
    welded.offsets.push_back(0);
  }
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    for (const VertexId v : corners) welded.corners.push_back(welded.ids[v]);
    if (!mesh.faces.are_triangles()) welded.offsets.push_back(welded.corners.size());
  });
  return welded;
}

std::vector<std::uint32_t> welded_ids(const PositionsView& positions, double eps) {
  check_eps(eps);
  validate(positions);
  return positions.visit([&]<class Real>(const StridedPositions<Real>& xyz) {
    std::vector<Real> kept;
    return weld_into(kept, xyz, eps);
  });
}

}  // namespace meshhood::inline v0_1::io
