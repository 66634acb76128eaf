// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/mesh.h"
#include "meshhood/surface.h"

namespace meshhood::wasm {

/// The arrays of the last answer, which JavaScript reads. Valid until the next call.
struct Answer {
  std::vector<VertexId> ids;
  std::vector<double> reals;          ///< distances, radii, aggregates, coordinates
  std::vector<std::uint32_t> counts;  ///< sizes, or the offsets of rows
};

/// One for each instance of the module, which has one thread.
inline Answer answer;

/// Adds all elements of the rows of a matrix.
template <class T, std::size_t N>
void append_rows(std::vector<T>& out, const std::vector<std::array<T, N>>& rows) {
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
}

/// Three ids, the vertices of the triangle; seven reals, its barycentric coordinates in it, the point and its distance;
/// and a count, the face, of which `kNoFace` has all bits set.
inline void append_point(const SurfacePoint& found) {
  answer.counts.push_back(static_cast<std::uint32_t>(found.face));
  answer.ids.insert(answer.ids.end(), found.vertices.begin(), found.vertices.end());
  answer.reals.insert(answer.reals.end(), found.barycentric.begin(), found.barycentric.end());
  answer.reals.insert(answer.reals.end(), found.point.begin(), found.point.end());
  answer.reals.push_back(found.distance);
}

}  // namespace meshhood::wasm
