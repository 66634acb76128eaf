// SPDX-License-Identifier: MIT
#include "surface/surface.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "meshhood/aggregate.h"
#include "meshhood/error.h"

#include "exact/neighbors.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

bool same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Throws unless the mesh has the vertices of the index, which has no faces to compare.
void check_positions(const IndexView& index, const MeshView& mesh) {
  if (mesh.positions.size() != index.vertex_count()) {
    raise(ErrorCode::InvalidMesh, "the mesh has " + std::to_string(mesh.positions.size()) +
                                      " vertices, but the index has " + std::to_string(index.vertex_count()));
  }
  mesh.positions.visit([&](const auto& given) {
    std::visit(
        [&](auto kept) {
          for (std::size_t i = 0; i < index.vertex_count(); ++i) {
            if (same(point(given, index.id(i)), point(kept, i))) continue;
            raise(ErrorCode::InvalidMesh, "vertex " + std::to_string(index.id(i)) +
                                              " has moved since the index was built, expected the same mesh");
          }
        },
        index.positions);
  });
}

FaceArrays copy(const MeshView& mesh) {
  validate(mesh);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (mesh.faces.size() > kMost) {
    raise(ErrorCode::TooLarge, std::to_string(mesh.faces.size()) + " faces, expected at most 2^32 - 1");
  }
  return make_face_arrays(mesh.faces);
}

std::vector<VertexId> read_changed(const IndicesView& changed, std::size_t vertices) {
  std::vector<VertexId> ids(changed.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (changed[i] >= vertices) {
      raise_no_such_vertex(ErrorCode::VertexOutOfRange, "changed: row " + std::to_string(i) + ": vertex ",
                           std::to_string(changed[i]), vertices);
    }
    ids[i] = static_cast<VertexId>(changed[i]);
  }
  sort_out(ids);
  return ids;
}

bool same(const Frame& a, const Frame& b) { return same(a.origin, b.origin) && a.scale == b.scale; }

}  // namespace

std::shared_ptr<SurfaceGeometry> SurfaceGeometry::copy() const {
  auto all = std::make_shared<SurfaceGeometry>();
  if (const Normals* const made = normals.made()) static_cast<void>(all->normals.get([&] { return *made; }));
  if (const FaceTree* const made = tree.made()) static_cast<void>(all->tree.get([&] { return *made; }));
  if (const PatchState* const made = patches.made()) static_cast<void>(all->patches.get([&] { return *made; }));
  return all;
}

Surface::State::State(const Index& given, FaceArrays faces)
    : searched(IndexAccess::alias(given)),
      index(searched),
      frame(index->frame),
      topology(std::make_shared<SurfaceFaces>(std::move(faces))),
      geometry(std::make_shared<SurfaceGeometry>()) {}

Surface::State::State(const Index& given, const State& other)
    : searched(IndexAccess::alias(given)),
      index(searched),
      frame(index->frame),
      topology(other.topology),
      geometry(other.geometry),
      has_own_normals(other.has_own_normals) {}

const FaceLists& Surface::State::lists() const {
  return topology->lists.get([&] {
    return gather_lists<std::uint32_t, std::uint64_t>(index->vertex_count(), [&](auto&& f) {
      for (std::size_t face = faces().size(); face-- > 0;) {
        for (const VertexId corner : faces()[face]) f(corner, static_cast<std::uint32_t>(face));
      }
    });
  });
}

const FaceTree& Surface::State::tree(TaskContext& task) const {
  return geometry->tree.get([&] { return FaceTree(*index, faces(), task); });
}

const NormalCones& Surface::State::cones(TaskContext& task) const {
  return geometry->cones.get([&] { return NormalCones(*index, tree(task)); });
}

const Normals& Surface::State::normals(TaskContext& task) const {
  return geometry->normals.get([&] {
    if (faces().size() == 0 && index->vertex_count() != 0) {
      raise(ErrorCode::InvalidMesh, "the mesh has no faces, expected faces or normals");
    }
    return make_normals(*index, faces().view(), task);
  });
}

const PatchState& Surface::State::patches(TaskContext& task) const {
  return kept_patches().get([&] { return PatchState(searched, faces(), task); });
}

Kept<PatchState>& Surface::State::kept_patches() const {
  return index->walls.empty() ? geometry->patches : walled_patches;
}

// Takes the positions in index order, but the faces in their order, so that sums have the bits of `vertex_areas`.
const std::vector<double>& Surface::State::areas() const {
  return geometry->areas.get([&] {
    FaceArrays in_order = topology->arrays;
    for (VertexId& corner : in_order.corners) corner = static_cast<VertexId>(index->place(corner));
    const StoredFaces all{in_order.corners, in_order.offsets};
    const std::vector<double> by_place = meshhood::vertex_areas(MeshView{searched.positions(), all.view()});
    std::vector<double> areas(by_place.size());
    for (std::size_t i = 0; i < areas.size(); ++i) areas[index->id(i)] = by_place[i];
    return areas;
  });
}

void Surface::State::check_refit(const Index& other) const {
  if (has_own_normals) {
    raise(ErrorCode::InvalidOption, "the surface has normals of its own, which do not follow a refit");
  }
  // Refits share the memory of what does not move.
  if (IndexAccess::view(other).slot.data() != index->slot.data()) {
    raise(ErrorCode::InvalidOption, "the index is of another mesh, expected a refit of that of the surface");
  }
}

void Surface::State::renew(SurfaceGeometry& made, std::span<const VertexId> changed) const {
  std::vector<std::uint32_t> moved;  // faces
  for (const VertexId v : changed) moved.insert(moved.end(), lists()[v].begin(), lists()[v].end());
  sort_out(moved);
  std::vector<VertexId> around;
  for (const std::uint32_t face : moved) around.insert(around.end(), faces()[face].begin(), faces()[face].end());
  sort_out(around);
  if (FaceTree* const tree = made.tree.made()) tree->renew(*index, faces(), moved);
  if (Normals* const normals = made.normals.made()) renew_normals(*index, faces(), lists(), around, *normals);
  // Polygons may have other triangles.
  PatchState* const patches = made.patches.made();
  if (patches == nullptr) return;
  if (index->walls.empty() && faces().offsets.empty()) {
    patches->renew(searched, changed);
  } else {
    made.patches.drop();
  }
}

Surface::Surface(const Index& index, const FacesView& faces)
    : Surface(std::make_unique<State>(index, copy(MeshView{index.positions(), faces}))) {}

Surface::Surface(const Index& index, const MeshView& mesh) : Surface(std::make_unique<State>(index, copy(mesh))) {
  check_positions(IndexAccess::view(index), mesh);
}

Surface::Surface(std::unique_ptr<State> state) : state_(std::move(state)) {}

Surface Surface::of_normals(const Index& index, std::span<const double> normals, const FacesView& faces) {
  auto state = std::make_unique<State>(index, copy(MeshView{index.positions(), faces}));
  static_cast<void>(state->geometry->normals.get([&] { return read_normals(*state->index, normals); }));
  state->has_own_normals = true;
  return Surface(std::move(state));
}

Surface Surface::on(const Index& index) const {
  const State& state = SurfaceAccess::state(*this);
  // Masked indices share this counter with their mesh; a refitted copy has its own.
  if (IndexAccess::view(index).newest != state.index->newest) {
    raise(ErrorCode::InvalidOption, "the index is of another mesh, expected one from `masked` of that of the surface");
  }
  return Surface(std::make_unique<State>(index, state));
}

void Surface::refit_in_place(const Index& index) {
  state_->check_refit(index);
  auto next = std::make_unique<State>(index, *state_);
  next->geometry = std::make_shared<SurfaceGeometry>();
  state_ = std::move(next);
}

void Surface::refit_in_place(const Index& index, const IndicesView& changed) {
  const std::vector<VertexId> moved = read_changed(changed, vertex_count());
  std::shared_ptr<SurfaceGeometry> made = state_->geometry;
  const bool is_in_frame = same(state_->frame, IndexAccess::view(index).frame);
  refit_in_place(index);
  if (!is_in_frame) return;
  if (made.use_count() > 1) {
    made = made->copy();  // another surface, or a searcher that was made before, keeps the original
  } else {
    // Another thread may have let go of it just now. `use_count` does not order what that thread has read before what
    // is written here; to let go of a copy does, since this changes the same counter.
    std::shared_ptr(made).reset();
  }
  // If memory runs out meanwhile, all is made again.
  state_->renew(*made, moved);
  made->areas.drop();
  made->cones.drop();
  state_->geometry = made;
}

std::size_t Surface::vertex_count() const { return state_->index->vertex_count(); }
std::size_t Surface::face_count() const { return state_->faces().size(); }

std::size_t Surface::bytes() const {
  const StoredFaces& faces = state_->faces();
  std::size_t bytes = faces.corners.size_bytes() + faces.offsets.size_bytes();
  if (const FaceLists* const lists = state_->topology->lists.made()) bytes += lists->bytes();
  if (const FaceTree* const tree = state_->geometry->tree.made()) bytes += tree->bytes();
  if (const NormalCones* const cones = state_->geometry->cones.made()) bytes += cones->bytes();
  if (state_->geometry->normals.made() != nullptr) bytes += 3 * sizeof(double) * vertex_count();
  if (const PatchState* const patches = state_->kept_patches().made()) bytes += patches->bytes();
  if (state_->geometry->areas.made() != nullptr) bytes += sizeof(double) * vertex_count();
  return bytes;
}

std::span<const double> Surface::vertex_areas() const& { return SurfaceAccess::state(*this).areas(); }

std::size_t OrientedIndex::first_neighbor(std::size_t place) const {
  std::size_t first = place;
  for_each_neighbor(*index, index->slot_at(place), [&](std::size_t other) {
    if (first == place || index->id(other) < index->id(first)) first = other;
  });
  return first;
}

OrientedIndex SurfaceAccess::oriented(const Surface& surface, unsigned threads) {
  TaskContext task(threads);
  return oriented(surface, task);
}

}  // namespace meshhood::inline v0_1
