// SPDX-License-Identifier: MIT
#include "parts/part_writer.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/mesh_data.h"

#include "io/file_writer.h"
#include "io/index_io.h"
#include "io/mesh_builder.h"
#include "io/npy.h"

namespace meshhood::parts {
namespace {

constexpr std::size_t kReadBuffer = std::size_t{1} << 20;

/// The vertices of a part, numbered in ascending order of their ids in the mesh.
std::vector<Site> read_vertices(const Spill& spill, std::size_t number) {
  std::vector<Site> vertices;
  vertices.reserve(static_cast<std::size_t>(spill.size(number) / sizeof(Site)));
  SpillReader reader(spill, number, kReadBuffer);
  for (Site vertex = {}; reader.next(vertex);) vertices.push_back(vertex);
  std::ranges::sort(vertices, {}, &Site::id);
  const auto repeats = std::ranges::unique(vertices, {}, &Site::id);
  vertices.erase(repeats.begin(), repeats.end());
  return vertices;
}

/// The faces of a part, by the places of their corners in `ids`.
io::Faces read_faces(const Spill& spill, std::size_t number, std::span<const std::int64_t> ids) {
  io::Faces faces;
  SpillReader reader(spill, number, kReadBuffer);
  for (std::uint64_t corners = 0; reader.next(corners);) {
    for (std::uint64_t i = 0; i < corners; ++i) {
      std::int64_t id = 0;
      [[maybe_unused]] const bool has_all = reader.next(id);
      assert(has_all);
      faces.append_corner(static_cast<std::uint32_t>(std::ranges::lower_bound(ids, id) - ids.begin()));
    }
    faces.end_face(corners);
  }
  return faces;
}

/// Writes numbers, none of which is negative, as an array of the signed type `T`.
template <class T, class Number>
void write_array(const std::filesystem::path& file, const std::vector<Number>& values) {
  static_assert(sizeof(T) == sizeof(Number));
  const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
  io::FileWriter writer(file);
  writer.write(io::npy_header(io::npy_type<T>(), fmt::format("({},)", values.size())));
  writer.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  writer.commit();
}

template <class Real>
std::vector<Real> positions_of(std::span<const Site> vertices) {
  std::vector<Real> xyz;
  xyz.reserve(3 * vertices.size());
  for (const auto& [p, id] : vertices) {
    for (const double x : {p.x, p.y, p.z}) xyz.push_back(static_cast<Real>(x));
  }
  return xyz;
}

std::vector<std::int64_t> ids_of(std::span<const Site> vertices) {
  std::vector<std::int64_t> ids;
  ids.reserve(vertices.size());
  for (const Site& vertex : vertices) ids.push_back(static_cast<std::int64_t>(vertex.id));
  return ids;
}

/// The numbers of the vertices that the part owns.
std::vector<std::int32_t> owned_by(std::size_t part, std::span<const Site> vertices, const CutTree& tree) {
  std::vector<std::int32_t> owned;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (tree.owner(vertices[i]) == part) owned.push_back(static_cast<std::int32_t>(i));
  }
  return owned;
}

/// Frees the positions, once the index has them.
void write_index(const std::filesystem::path& file, MeshData& mesh, const Run& run) {
  const Index index = build(mesh.view(), run);
  mesh.positions.emplace<0>();
  io::save(file, index, {}, {.progress = run.progress});
}

void check_count(std::size_t vertices, std::size_t part) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (vertices <= kMost) return;
  raise(ErrorCode::TooLarge, fmt::format("part {} has {} vertices with its halo, but the limit is {}: use more parts",
                                         part, vertices, kMost));
}

}  // namespace

std::uint64_t part_memory(const PartContents& contents, std::size_t part) {
  // Measured on surfaces, and rounded up: tests/parts/memory_test.cpp. Faces take as many bytes as in their list.
  constexpr std::uint64_t kBytesPerVertex = 250;
  return contents.vertices.size(part) / sizeof(Site) * kBytesPerVertex + contents.faces.size(part);
}

Part write_part_files(const std::filesystem::path& folder, const PartContents& contents, std::size_t number,
                      const CutTree& tree, bool is_double, const Run& run) {
  std::vector<Site> vertices = read_vertices(contents.vertices, number);
  check_count(vertices.size(), number);
  const std::vector<std::int64_t> ids = ids_of(vertices);
  const std::vector<std::int32_t> owned = owned_by(number, vertices, tree);
  MeshData mesh;
  is_double ? mesh.positions = positions_of<double>(vertices) : mesh.positions = positions_of<float>(vertices);
  std::vector<Site>().swap(vertices);
  io::Faces faces = read_faces(contents.faces, number, ids);
  mesh.offsets = std::move(faces.offsets());
  mesh.corners = std::move(faces.corners());

  write_index(folder / kIndexFile, mesh, run);
  write_array<std::int64_t>(folder / kVerticesFile, ids);
  write_array<std::int32_t>(folder / kOwnedFile, owned);
  write_array<std::int32_t>(folder / kCornersFile, mesh.corners);
  write_array<std::int64_t>(folder / kOffsetsFile, mesh.offsets);
  Part part{.vertices = ids.size(), .owned = owned.size(), .faces = faces.size(), .files = {}};
  for (const std::string_view name : kPartFiles) part.files.push_back(describe_file(folder, name));
  return part;
}

}  // namespace meshhood::parts
