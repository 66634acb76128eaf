// SPDX-License-Identifier: MIT
#include "meshhood/mesh.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "meshhood/error.h"

#include "base/validate.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns the first of the numbers `0 .. count - 1` that is not valid, whatever the thread that finds one first;
/// `count` if there is none.
template <class IsValid>
std::size_t first_invalid(std::size_t count, TaskContext& task, IsValid&& is_valid) {
  constexpr std::size_t kGrain = 4096;  // a chunk of this size takes much longer than passing it to a thread
  std::atomic<std::size_t> first{count};
  task.parallel_for(count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    std::size_t i = begin;
    while (i < end && is_valid(i)) ++i;
    if (i == end) return;
    for (std::size_t known = first; i < known && !first.compare_exchange_weak(known, i);) {
    }
  });
  return first;
}

void validate_coordinates(const PositionsView& positions, TaskContext& task) {
  positions.visit([&](const auto& xyz) {
    const std::size_t v =
        first_invalid(xyz.size(), task, [&](std::size_t i) { return is_valid_position(point(xyz, i)); });
    if (v < xyz.size()) refuse_position(v, point(xyz, v));
  });
}

/// Checks that the offsets ascend from 0 to the number of corners.
void validate_offsets(const IndicesView& offsets, std::size_t corners) {
  const auto text_of = [&](std::size_t i) { return to_text(offsets, i); };
  if (offsets.size() == 0) {
    if (corners != 0) {
      raise(ErrorCode::InvalidMesh, "face offsets are empty, but there are " + std::to_string(corners) + " corners");
    }
    return;
  }
  if (offsets[0] != 0) {
    raise(ErrorCode::InvalidMesh, "face offsets begin with " + text_of(0) + ", expected 0");
  }
  const std::size_t faces = offsets.size() - 1;
  const std::size_t face = offsets.visit([&](auto all) {
    std::size_t i = 0;
    while (i < faces && all[i + 1] >= all[i]) ++i;
    return i;
  });
  if (face < faces) {
    raise(ErrorCode::InvalidMesh, "face " + std::to_string(face) + " ends at corner " + text_of(face + 1) +
                                      ", before it begins at " + text_of(face));
  }
  if (offsets[faces] != corners) {
    raise(ErrorCode::InvalidMesh,
          "face offsets end with " + text_of(faces) + ", but there are " + std::to_string(corners) + " corners");
  }
}

/// Returns whether the last corner of the last triangle, `(#F - 1) * face_stride + 2 * corner_stride`, is one of
/// `corners`. It divides, because that number may have more than 64 bits.
bool fit_into(std::size_t corners, const FacesView& faces) {
  if (faces.size() == 0) return true;
  if (corners == 0 || faces.corner_stride() > (corners - 1) / 2) return false;
  const std::size_t room = corners - 1 - 2 * faces.corner_stride();
  return faces.size() == 1 || faces.face_stride() <= room / (faces.size() - 1);
}

void validate_triangles(const FacesView& faces) {
  const std::size_t corners = faces.corners().size();
  // Without a stride, all faces would be the same one, in any number.
  if (faces.size() > 1 && faces.face_stride() == 0) {
    raise(ErrorCode::InvalidMesh,
          std::to_string(faces.size()) + " triangles with a face stride of 0, expected 1 or more");
  }
  if (!fit_into(corners, faces)) {
    raise(ErrorCode::InvalidMesh,
          std::to_string(faces.size()) + " triangles with strides " + std::to_string(faces.face_stride()) + " and " +
              std::to_string(faces.corner_stride()) + " exceed the " + std::to_string(corners) + " corner indices");
  }
  const bool is_by_rows = faces.face_stride() == 3 && faces.corner_stride() == 1;
  const bool is_by_columns = faces.face_stride() == 1 && faces.corner_stride() == faces.size();
  if ((is_by_rows || is_by_columns) && corners % 3 != 0) {
    raise(ErrorCode::InvalidMesh, std::to_string(corners) + " corners, expected three a triangle");
  }
}

template <class Index>
[[noreturn]] void raise_corner(std::size_t face, std::size_t i, Index vertex, std::size_t vertices) {
  raise_no_such_vertex(ErrorCode::InvalidMesh,
                       "face " + std::to_string(face) + ": corner " + std::to_string(i) + " is vertex ",
                       std::to_string(vertex), vertices);
}

/// Corner `i` of a face is `corners[first + i * stride]`, for `count` corners.
struct CornerPlaces {
  std::size_t first;
  std::size_t count;
  std::size_t stride;
};

CornerPlaces places_of(const FacesView& faces, std::size_t face) {
  if (faces.are_triangles()) return {face * faces.face_stride(), 3, faces.corner_stride()};
  const auto begin = static_cast<std::size_t>(faces.offsets()[face]);
  const auto end = static_cast<std::size_t>(faces.offsets()[face + 1]);
  return {begin, end - begin, 1};
}

/// A negative corner is huge when read as unsigned, so that one comparison detects both faults.
void validate_corners(const FacesView& faces, std::size_t vertices, TaskContext& task) {
  faces.corners().visit([&](auto corners) {
    const auto is_valid = [&](const CornerPlaces& places, std::size_t i) {
      return static_cast<std::uint64_t>(corners[places.first + i * places.stride]) < vertices;
    };
    const std::size_t face = first_invalid(faces.size(), task, [&](std::size_t f) {
      const CornerPlaces places = places_of(faces, f);
      bool are_valid = true;
      for (std::size_t i = 0; i < places.count; ++i) are_valid &= is_valid(places, i);
      return are_valid;
    });
    if (face == faces.size()) return;
    const CornerPlaces places = places_of(faces, face);
    std::size_t i = 0;
    while (is_valid(places, i)) ++i;
    raise_corner(face, i, corners[places.first + i * places.stride], vertices);
  });
}

/// Returns the memory of indices whose type has the size of `VertexId`; otherwise null. Valid indices are not negative,
/// and a signed type may be read as the unsigned one of its size.
const VertexId* as_ids(const IndicesView& indices) {
  return indices.visit([]<class Index>(std::span<const Index> all) {
    return sizeof(Index) == sizeof(VertexId) ? reinterpret_cast<const VertexId*>(all.data()) : nullptr;
  });
}

}  // namespace

std::span<const VertexId> FacesView::triangles_from(std::size_t face, std::vector<VertexId>& copy) const {
  if (const VertexId* const ids = as_ids(corners_); ids && face_stride_ == 3 && corner_stride_ == 1) {
    return {ids + 3 * face, 3 * (count_ - face)};
  }
  // A call for each triangle would take longer than to convert it.
  constexpr std::size_t kMost = 256;
  const std::size_t count = std::min(count_ - face, kMost);
  copy.resize(3 * count);
  corners_.visit([&](auto corners) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = (face + i) * face_stride_;
      for (std::size_t j = 0; j < 3; ++j) copy[3 * i + j] = static_cast<VertexId>(corners[first + j * corner_stride_]);
    }
  });
  return copy;
}

std::span<const VertexId> FacesView::polygon(std::size_t face, std::vector<VertexId>& copy) const {
  const auto [first, count, stride] = places_of(*this, face);
  if (const VertexId* const ids = as_ids(corners_)) return {ids + first, count};
  copy.resize(count);
  corners_.visit([&](auto corners) {
    for (std::size_t i = 0; i < count; ++i) copy[i] = static_cast<VertexId>(corners[first + i]);
  });
  return copy;
}

void validate(const PositionsView& positions) {
  TaskContext task;
  validate(positions, task);
}

void validate(const MeshView& mesh) {
  TaskContext task;
  validate(mesh, task);
}

void validate(const PositionsView& positions, TaskContext& task) {
  const std::size_t scalars = positions.scalar_count();
  if (scalars % 3 != 0) {
    raise(ErrorCode::InvalidMesh, std::to_string(scalars) + " coordinates, expected three a vertex");
  }
  if (positions.size() > kMaxVertices) {
    raise(ErrorCode::TooLarge,
          std::to_string(positions.size()) + " vertices, but the limit is " + std::to_string(kMaxVertices));
  }
  validate_coordinates(positions, task);
}

void validate(const MeshView& mesh, TaskContext& task) {
  validate(mesh.positions, task);
  if (mesh.faces.are_triangles()) {
    validate_triangles(mesh.faces);
  } else {
    validate_offsets(mesh.faces.offsets(), mesh.faces.corners().size());
  }
  validate_corners(mesh.faces, mesh.positions.size(), task);
}

}  // namespace meshhood::inline v0_1
