// SPDX-License-Identifier: MIT
#include "surface/face_points.h"

#include <string>

#include "meshhood/error.h"

#include "exact/query/arguments.h"
#include "shared/text.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {

FacePoints::FacePoints(const StoredFaces& mesh, const IndicesView& faces, std::span<const SpacePoint> points)
    : points_(points.begin(), points.end()) {
  if (points.size() != faces.size()) {
    raise(ErrorCode::InvalidOption, std::to_string(points.size()) + " points, expected one for each of " +
                                        std::to_string(faces.size()) + " faces");
  }
  faces_.reserve(faces.size());
  corners_.reserve(faces.size());
  for (std::size_t row = 0; row < faces.size(); ++row) {
    const std::size_t face = faces[row];
    if (face >= mesh.size()) raise_no_such_face(face, mesh.size(), named("faces", row));
    faces_.push_back(face);
    corners_.push_back(mesh[face].empty() ? 0 : mesh[face][0]);
  }
  check_points(points_, "points");
}

}  // namespace meshhood::inline v0_1
