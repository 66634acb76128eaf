// SPDX-License-Identifier: MIT
#include "meshhood/reorder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "base/adjacency.h"
#include "exact/index_access.h"
#include "exact/layout.h"

namespace meshhood::inline v0_1 {
namespace {

/// Makes the index order the caller's order: the index then needs no permutation. Returns the former permutation.
std::vector<VertexId> adopt_order(IndexData& index) {
  const RawVector<VertexId> padded = std::exchange(index.permutation, {});
  std::vector<VertexId> permutation(padded.begin(), padded.begin() + static_cast<std::ptrdiff_t>(index.slot.size()));
  for (std::size_t leaf = 0; leaf + 1 < index.leaf_begin.size(); ++leaf) {
    const auto slot = static_cast<std::uint32_t>(leaf * kLeafCapacity);
    std::iota(index.slot.begin() + static_cast<std::ptrdiff_t>(index.leaf_begin[leaf]),
              index.slot.begin() + static_cast<std::ptrdiff_t>(index.leaf_begin[leaf + 1]), slot);
  }
  return permutation;
}

std::vector<VertexId> inverse(std::span<const VertexId> permutation) {
  std::vector<VertexId> result(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i) result[permutation[i]] = static_cast<VertexId>(i);
  return result;
}

/// Returns the new number of each face. Faces are sorted by their first vertex in the new order, those without corners
/// last, and keep their order otherwise.
std::vector<std::uint32_t> number_faces(const FacesView& faces, std::span<const VertexId> new_id) {
  const auto first_vertex = [&](std::span<const VertexId> corners) {
    std::size_t first = new_id.size();
    for (const VertexId corner : corners) first = std::min<std::size_t>(first, new_id[corner]);
    return first;
  };
  std::vector<std::uint32_t> next(new_id.size() + 2, 0);
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) { ++next[first_vertex(corners) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> number(faces.size());
  faces.for_each(
      [&](std::size_t face, std::span<const VertexId> corners) { number[face] = next[first_vertex(corners)]++; });
  return number;
}

void add_faces(const FacesView& faces, std::span<const VertexId> new_id, ReorderedMesh& out) {
  const std::vector<std::uint32_t> number = number_faces(faces, new_id);
  out.face_permutation.resize(faces.size());
  out.face_offsets.resize(faces.size() + 1);
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    out.face_permutation[number[face]] = static_cast<std::uint32_t>(face);
    out.face_offsets[number[face] + std::size_t{1}] = static_cast<std::uint32_t>(corners.size());
  });
  std::partial_sum(out.face_offsets.begin(), out.face_offsets.end(), out.face_offsets.begin());
  out.corners.resize(out.face_offsets.back());
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    std::transform(corners.begin(), corners.end(), out.corners.begin() + out.face_offsets[number[face]],
                   [&](VertexId corner) { return new_id[corner]; });
  });
  if (faces.are_triangles()) out.face_offsets = {};
}

}  // namespace

MeshView ReorderedMesh::view() const& {
  return {index.positions(),
          face_offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(face_offsets, corners)};
}

ReorderedMesh reorder(const MeshView& mesh, const Run& run) {
  TaskContext task(run.threads, run.progress, IndexAccess::kBuildSteps);
  if (mesh.faces.size() > std::numeric_limits<std::uint32_t>::max()) {
    raise(ErrorCode::TooLarge, std::to_string(mesh.faces.size()) + " faces, but the limit is " +
                                   std::to_string(std::numeric_limits<std::uint32_t>::max()));
  }
  IndexData arrays = IndexAccess::build_arrays(mesh, task);
  std::vector<VertexId> permutation = adopt_order(arrays);
  ReorderedMesh result{IndexAccess::make(std::move(arrays)), std::move(permutation), {}, {}, {}};
  add_faces(mesh.faces, inverse(result.permutation), result);
  task.report_progress();
  return result;
}

}  // namespace meshhood::inline v0_1
