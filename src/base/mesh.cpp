// SPDX-License-Identifier: MIT
#include "meshhood/mesh.h"

#include <cmath>
#include <string>

#include "meshhood/error.h"

#include "base/distance.h"
#include "base/text.h"

namespace meshhood {
namespace {

template <class Real>
void validate_coordinates(std::span<const Real> xyz) {
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    const auto value = static_cast<double>(xyz[i]);
    if (std::abs(value) <= kLargestCoordinate) [[likely]] {
      continue;
    }
    raise(ErrorCode::InvalidMesh, "vertex " + std::to_string(i / 3) + ": " + "xyz"[i % 3] + " is " + to_text(value) +
                                      ", expected a finite number of at most 2^500 in size");
  }
}

/// Where polygon `face` ends must not lie before where it begins, nor beyond the corners.
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

/// A negative corner becomes a huge one when it is read as unsigned, so one comparison finds both.
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
  positions.visit([](auto xyz) { validate_coordinates(xyz); });
}

void validate(const MeshView& mesh) {
  validate(mesh.positions);
  const std::size_t corners = mesh.faces.corners().size();
  if (mesh.faces.are_triangles()) {
    if (corners % 3 != 0) {
      raise(ErrorCode::InvalidMesh, std::to_string(corners) + " corners, expected three a triangle");
    }
  } else {
    mesh.faces.offsets().visit([&](auto offsets) { validate_offsets(offsets, corners); });
  }
  validate_corners(mesh.faces, mesh.positions.size());
}

}  // namespace meshhood
