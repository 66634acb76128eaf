// SPDX-License-Identifier: MIT
// The functions that JavaScript calls (bindings/wasm/instance.js). An instance of the module holds one mesh and its
// index. Memory for arguments is taken with `allocate` and given back with `release`. Arrays of results stay valid
// until the next call of the function that makes them. Errors reach JavaScript through `raise`.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/meshhood.h"

#include "host.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

// One for each instance, which has one thread.
Workspace workspace;
std::vector<VertexId> ids;
std::vector<double> distances;
std::vector<std::uint32_t> offsets;
std::vector<std::byte> saved;
std::string names;

const Progress kProgress = [](std::size_t done, std::size_t total) { return report_progress(done, total); };

[[noreturn]] void refuse_memory() { raise(ErrorCode::TooLarge, "not enough memory"); }

std::string to_string(const char* text, std::size_t size) { return {text, size}; }

std::span<const std::byte> to_bytes(const void* data, std::size_t size) {
  return {static_cast<const std::byte*>(data), size};
}

/// `v` is a whole number, as JavaScript has checked.
VertexId to_vertex(double v) {
  const std::size_t vertices = workspace.index().vertex_count();
  if (v >= 0 && v < static_cast<double>(vertices)) return static_cast<VertexId>(v);
  raise(ErrorCode::VertexOutOfRange, "vertex " + std::to_string(static_cast<std::int64_t>(v)) + ", but the mesh has " +
                                         std::to_string(vertices) + " vertices");
}

PositionsView view_positions(const void* xyz, std::size_t scalars, bool is_double) {
  if (is_double) return std::span(static_cast<const double*>(xyz), scalars);
  return std::span(static_cast<const float*>(xyz), scalars);
}

IndicesView view_indices(const void* indices, std::size_t count, bool is_signed) {
  if (is_signed) return std::span(static_cast<const std::int32_t*>(indices), count);
  return std::span(static_cast<const std::uint32_t*>(indices), count);
}

}  // namespace

extern "C" {

// Memory.

[[clang::export_name("allocate")]] void* allocate(std::size_t bytes) {
  void* const memory = std::aligned_alloc(kIndexAlignment, (bytes / kIndexAlignment + 1) * kIndexAlignment);
  if (memory == nullptr) refuse_memory();
  return memory;
}

[[clang::export_name("release")]] void release(void* memory) { std::free(memory); }

/// To be called once, before all others.
[[clang::export_name("start")]] void start() { std::set_new_handler(refuse_memory); }

// Mesh files.

[[clang::export_name("read_mesh")]] void read_mesh(const void* file, std::size_t size, const char* name,
                                                   std::size_t name_size, int precision, bool strict) {
  workspace.read(to_bytes(file, size), to_string(name, name_size),
                 {.precision = static_cast<io::Precision>(precision), .strict = strict, .progress = kProgress});
}

[[clang::export_name("mesh_format")]] int mesh_format() { return static_cast<int>(workspace.mesh().format); }

[[clang::export_name("mesh_is_double")]] bool mesh_is_double() { return workspace.mesh().positions.index() == 1; }

[[clang::export_name("mesh_positions")]] const void* mesh_positions() {
  return std::visit([](const auto& xyz) { return static_cast<const void*>(xyz.data()); }, workspace.mesh().positions);
}

[[clang::export_name("mesh_scalar_count")]] std::size_t mesh_scalar_count() {
  return std::visit([](const auto& xyz) { return xyz.size(); }, workspace.mesh().positions);
}

[[clang::export_name("mesh_corners")]] const std::uint32_t* mesh_corners() { return workspace.mesh().corners.data(); }

[[clang::export_name("mesh_corner_count")]] std::size_t mesh_corner_count() { return workspace.mesh().corners.size(); }

/// Of polygons; none if all faces are triangles.
[[clang::export_name("mesh_offsets")]] const std::uint32_t* mesh_offsets() {
  offsets.assign(workspace.mesh().offsets.begin(), workspace.mesh().offsets.end());
  return offsets.data();
}

[[clang::export_name("mesh_offset_count")]] std::size_t mesh_offset_count() { return workspace.mesh().offsets.size(); }

/// One line for each warning, and their length.
[[clang::export_name("mesh_warnings")]] const char* mesh_warnings() {
  names.clear();
  for (const io::Warning& warning : workspace.mesh().warnings) {
    names += warning.first_place + ": " + warning.what;
    if (warning.count > 1) names += " (" + std::to_string(warning.count) + " times)";
    names += '\n';
  }
  return names.data();
}

[[clang::export_name("text_size")]] std::size_t text_size() { return names.size(); }

// Index.

/// `offset_count` is 0 for triangles.
[[clang::export_name("build")]] void build(const void* xyz, std::size_t scalars, bool is_double, const void* corners,
                                           std::size_t corner_count, bool signed_corners, const void* face_offsets,
                                           std::size_t offset_count, bool signed_offsets) {
  const IndicesView corner_view = view_indices(corners, corner_count, signed_corners);
  const IndicesView offset_view = view_indices(face_offsets, offset_count, signed_offsets);
  FacesView faces = FacesView::polygons(offset_view, corner_view);
  if (offset_count == 0) faces = FacesView::triangles(corner_view);
  workspace.build({view_positions(xyz, scalars, is_double), faces}, {.progress = kProgress});
}

[[clang::export_name("load")]] void load(const void* bytes, std::size_t size) {
  workspace.load(to_bytes(bytes, size), {.progress = kProgress});
}

/// Returns the bytes of the index file; `saved_size` has their number.
[[clang::export_name("save")]] const std::byte* save() {
  saved.clear();
  meshhood::save(workspace.index(),
                 [](std::span<const std::byte> bytes) { saved.insert(saved.end(), bytes.begin(), bytes.end()); });
  return saved.data();
}

[[clang::export_name("saved_size")]] std::size_t saved_size() { return saved.size(); }

[[clang::export_name("release_saved")]] void release_saved() { saved = {}; }

[[clang::export_name("vertex_count")]] std::size_t vertex_count() { return workspace.index().vertex_count(); }

[[clang::export_name("index_bytes")]] std::size_t index_bytes() { return workspace.index().bytes().total(); }

[[clang::export_name("mean_edge_length")]] double mean_edge_length() { return workspace.mean_edge(); }

[[clang::export_name("graph_is_double")]] bool graph_is_double() { return workspace.graph().positions.index() == 1; }

[[clang::export_name("graph_positions")]] const void* graph_positions() {
  return std::visit([](const auto& xyz) { return static_cast<const void*>(xyz.data()); }, workspace.graph().positions);
}

// Queries. `method` is a `Method`.

/// Returns the number of ids.
[[clang::export_name("query")]] std::size_t query(Method method, double v, double radius, bool with_distances) {
  const VertexId vertex = to_vertex(v);
  workspace.with_searcher(method, [&](auto& searcher) {
    if (with_distances) {
      searcher.neighborhood(vertex, radius, ids, distances);
    } else {
      searcher.neighborhood(vertex, radius, ids);
    }
  });
  return ids.size();
}

[[clang::export_name("count")]] std::size_t count(Method method, double v, double radius) {
  const VertexId vertex = to_vertex(v);
  return workspace.with_searcher(method, [&](auto& searcher) { return searcher.count(vertex, radius); });
}

/// All vertices if `vertices` is null, and `radius` for all rows if `radii` is null. Returns the number of ids of all
/// rows; with `count_only`, `answer_offsets` has the size of each row instead.
[[clang::export_name("batch")]] std::size_t batch(Method method, const VertexId* vertices, std::size_t vertex_count,
                                                  double radius, const double* radii, std::size_t radius_count,
                                                  bool count_only, bool with_distances, bool sorted) {
  BatchQuery query;
  if (vertices != nullptr) query.vertices = std::span(vertices, vertex_count);
  query.radius = radius;
  if (radii != nullptr) query.radius = std::span(radii, radius_count);
  const SearchMethod search = workspace.search_method(method);
  if (count_only) {
    const auto sizes = neighborhood_sizes(search, query);
    offsets.assign(sizes.begin(), sizes.end());
    return offsets.size();
  }
  Neighborhoods rows = neighborhoods(search, query, {.distances = with_distances, .sorted = sorted});
  offsets.assign(rows.offsets.begin(), rows.offsets.end());
  ids = std::move(rows.ids);
  distances = std::move(rows.distances);
  return ids.size();
}

[[clang::export_name("answer_ids")]] const VertexId* answer_ids() { return ids.data(); }

[[clang::export_name("answer_distances")]] const double* answer_distances() { return distances.data(); }

[[clang::export_name("answer_offsets")]] const std::uint32_t* answer_offsets() { return offsets.data(); }

[[clang::export_name("answer_offset_count")]] std::size_t answer_offset_count() { return offsets.size(); }

[[clang::export_name("release_batch")]] void release_batch() {
  ids = {};
  distances = {};
  offsets = {};
}

}  // extern "C"

}  // namespace meshhood::wasm
