// SPDX-License-Identifier: MIT
#include "meshhood/mesh.h"

#include <string>

#include "meshhood/error.h"

#include "base/distance.h"
#include "base/valid_position.h"

namespace meshhood {
namespace {

template <class Real>
void validate_coordinates(const StridedPositions<Real>& xyz) {
  for (std::size_t v = 0; v < xyz.size(); ++v) check_position(v, point(xyz, v));
}

/// Offsets must ascend from 0 to the number of corners.
template <class Index>
void validate_offsets(std::span<const Index> offsets, std::size_t corners) {
  if (offsets.empty()) {
    if (corners != 0) {
      raise(ErrorCode::InvalidMesh, "face offsets are empty, but there are " + std::to_string(corners) + " corners");
    }
    return;
  }
  if (offsets[0] != 0) {
    raise(ErrorCode::InvalidMesh, "face offsets begin with " + std::to_string(offsets[0]) + ", expected 0");
  }
  for (std::size_t face = 0; face + 1 < offsets.size(); ++face) {
    if (offsets[face + 1] < offsets[face]) {
      raise(ErrorCode::InvalidMesh, "face " + std::to_string(face) + " ends at corner " +
                                        std::to_string(offsets[face + 1]) + ", before it begins at " +
                                        std::to_string(offsets[face]));
    }
  }
  if (static_cast<std::uint64_t>(offsets.back()) != corners) {
    raise(ErrorCode::InvalidMesh, "face offsets end with " + std::to_string(offsets.back()) + ", but there are " +
                                      std::to_string(corners) + " corners");
  }
}

void validate_triangles(const FacesView& faces) {
  const std::size_t corners = faces.corners().size();
  const std::size_t needed =
      faces.size() == 0 ? 0 : (faces.size() - 1) * faces.face_stride() + 2 * faces.corner_stride() + 1;
  if (corners < needed) {
    raise(ErrorCode::InvalidMesh, std::to_string(corners) + " corner indices, but " + std::to_string(faces.size()) +
                                      " triangles with strides " + std::to_string(faces.face_stride()) + " and " +
                                      std::to_string(faces.corner_stride()) + " need " + std::to_string(needed));
  }
  const bool is_by_rows = faces.face_stride() == 3 && faces.corner_stride() == 1;
  const bool is_by_columns = faces.face_stride() == 1 && faces.corner_stride() == faces.size();
  if ((is_by_rows || is_by_columns) && corners % 3 != 0) {
    raise(ErrorCode::InvalidMesh, std::to_string(corners) + " corners, expected three a triangle");
  }
}

/// A negative corner is huge when read as unsigned, so that one comparison detects both faults.
void validate_corners(const FacesView& faces, std::size_t vertices) {
  faces.for_each([&](std::size_t face, auto corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (static_cast<std::uint64_t>(corners[i]) < vertices) [[likely]] {
        continue;
      }
      raise(ErrorCode::InvalidMesh, "face " + std::to_string(face) + ": corner " + std::to_string(i) + " is vertex " +
                                        std::to_string(corners[i]) + ", but the mesh has " + std::to_string(vertices) +
                                        " vertices");
    }
  });
}

}  // namespace

void validate(const PositionsView& positions) {
  const std::size_t scalars = positions.scalar_count();
  if (scalars % 3 != 0) {
    raise(ErrorCode::InvalidMesh, std::to_string(scalars) + " coordinates, expected three a vertex");
  }
  if (positions.size() > kMaxVertices) {
    raise(ErrorCode::TooLarge,
          std::to_string(positions.size()) + " vertices, but the limit is " + std::to_string(kMaxVertices));
  }
  positions.visit([](const auto& xyz) { validate_coordinates(xyz); });
}

void validate(const MeshView& mesh) {
  validate(mesh.positions);
  if (mesh.faces.are_triangles()) {
    validate_triangles(mesh.faces);
  } else {
    mesh.faces.offsets().visit([&](auto offsets) { validate_offsets(offsets, mesh.faces.corners().size()); });
  }
  validate_corners(mesh.faces, mesh.positions.size());
}

}  // namespace meshhood
