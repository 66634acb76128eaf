// SPDX-License-Identifier: MIT
// The index: making, saving and loading it, and its properties.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "host.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

std::vector<std::byte> saved;

IndicesView view_indices(const void* indices, std::size_t count, bool is_signed) {
  if (is_signed) return std::span(static_cast<const std::int32_t*>(indices), count);
  return std::span(static_cast<const std::uint32_t*>(indices), count);
}

}  // namespace

[[clang::export_name("take_positions")]] void take_positions(const void* xyz, std::size_t scalars, bool is_double) {
  if (is_double) {
    given.positions = std::span(static_cast<const double*>(xyz), scalars);
  } else {
    given.positions = std::span(static_cast<const float*>(xyz), scalars);
  }
}

/// `offset_count` is 0 for triangles.
[[clang::export_name("take_faces")]] void take_faces(const void* corners, std::size_t corner_count, bool signed_corners,
                                                     const void* offsets, std::size_t offset_count,
                                                     bool signed_offsets) {
  const IndicesView flat = view_indices(corners, corner_count, signed_corners);
  given.faces = offset_count == 0 ? FacesView::triangles(flat)
                                  : FacesView::polygons(view_indices(offsets, offset_count, signed_offsets), flat);
}

/// The same with the faces that the index holds. Returns whether it holds any.
[[clang::export_name("take_held_faces")]] bool take_held_faces() {
  const std::optional<FacesView> faces = workspace.index().faces();
  if (faces) given.faces = *faces;
  return faces.has_value();
}

/// `cut` are the ends of edges that no search crosses, or null.
[[clang::export_name("build")]] void build(const VertexId* cut, std::size_t cut_count) {
  const Run run{.progress = report_progress};
  if (cut_count == 0) return workspace.replace_index(meshhood::build(given, run));
  const Adjacency whole = adjacency(given);
  subject = "cut: ";
  const Adjacency rest = cut_edges(whole.view(), std::span(cut, cut_count));
  subject.clear();
  workspace.replace_index(meshhood::build(GraphView{given.positions, rest.view()}, run));
}

[[clang::export_name("load")]] void load(const void* bytes, std::size_t size) {
  workspace.replace_index(meshhood::load(view_bytes(bytes, size), {.progress = report_progress}));
}

/// All vertices have moved if `changed` is null.
[[clang::export_name("refit")]] void refit(const VertexId* changed, std::size_t changed_count) {
  std::optional<IndicesView> list;
  if (changed != nullptr) list = std::span(changed, changed_count);
  workspace.refit(given.positions, list);
}

/// Returns the bytes of the index file; `save_size` has their number.
[[clang::export_name("save")]] const std::byte* save() {
  saved.clear();
  meshhood::save(workspace.index(),
                 [](std::span<const std::byte> bytes) { saved.insert(saved.end(), bytes.begin(), bytes.end()); });
  return saved.data();
}

[[clang::export_name("save_size")]] std::size_t save_size() { return saved.size(); }

[[clang::export_name("release_saved")]] void release_saved() { saved = {}; }

[[clang::export_name("vertex_count")]] std::size_t vertex_count() { return workspace.index().vertex_count(); }

[[clang::export_name("index_bytes")]] std::size_t index_bytes() { return workspace.index().bytes().total(); }

[[clang::export_name("mean_edge_length")]] double mean_edge_length() { return workspace.mean_edge(); }

/// Null where the vertices are in index order: the library then has none.
[[clang::export_name("permutation")]] const VertexId* permutation() {
  const std::span<const VertexId> ids = workspace.index().permutation();
  return ids.empty() ? nullptr : ids.data();
}

[[clang::export_name("graph_is_double")]] bool graph_is_double() { return workspace.graph().positions.index() == 1; }

[[clang::export_name("graph_positions")]] const void* graph_positions() {
  return std::visit([](const auto& xyz) { return static_cast<const void*>(xyz.data()); }, workspace.graph().positions);
}

/// The answer is the faces that the index holds: their corners in `ids`, their offsets in `counts`, none if all are
/// triangles. Returns whether it holds any.
[[clang::export_name("held_faces")]] bool held_faces() {
  if (!take_held_faces()) return false;
  const auto copy = [](const IndicesView& from, std::vector<std::uint32_t>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<std::uint32_t>(from[i]);
  };
  copy(given.faces.corners(), answer.ids);
  copy(given.faces.offsets(), answer.counts);
  return true;
}

/// Three reals: see `Quality`.
[[clang::export_name("quality")]] void quality() {
  const Quality found = meshhood::quality(workspace.index());
  answer.reals = {found.mean_radius, found.rebuilt_radius, found.gain};
}

}  // namespace meshhood::wasm
