// SPDX-License-Identifier: MIT
#include "parts/part_writer.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

#include "io/file_writer.h"
#include "io/index_io.h"
#include "io/npy.h"

namespace meshhood::parts {
namespace {

constexpr std::size_t kReadBuffer = std::size_t{1} << 20;
constexpr std::size_t kVertexWords = 4;

/// The vertices of a part, numbered in ascending order of their ids in the mesh.
std::vector<Site> read_vertices(const Spill& spill, std::size_t number) {
  std::vector<Site> vertices;
  vertices.reserve(static_cast<std::size_t>(spill.size(number) / kVertexWords));
  SpillReader reader(spill, number, kReadBuffer);
  for (;;) {
    const auto words = reader.next(kVertexWords);
    if (words.empty()) break;
    const auto coordinate = [&](std::size_t i) { return std::bit_cast<double>(words[i]); };
    vertices.push_back({{coordinate(1), coordinate(2), coordinate(3)}, words[0]});
  }
  std::sort(vertices.begin(), vertices.end(), [](const Site& a, const Site& b) { return a.id < b.id; });
  const auto same = [](const Site& a, const Site& b) { return a.id == b.id; };
  vertices.erase(std::unique(vertices.begin(), vertices.end(), same), vertices.end());
  return vertices;
}

/// The faces of a part, as a view for `build`.
struct Faces {
  std::vector<std::int32_t> corners;  ///< numbers of the part
  std::vector<std::int64_t> offsets;  ///< #F + 1; empty if all faces are triangles
  std::uint64_t count = 0;

  [[nodiscard]] FacesView view() const {
    return offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(offsets, corners);
  }
};

Faces read_faces(const Spill& spill, std::size_t number, std::span<const std::int64_t> ids) {
  Faces faces;
  std::vector<std::int64_t> ends{0};
  SpillReader reader(spill, number, kReadBuffer);
  bool are_triangles = true;
  for (;;) {
    const auto degree = reader.next(1);
    if (degree.empty()) break;
    const std::uint64_t corners = degree[0];
    for (std::uint64_t i = 0; i < corners; ++i) {
      const auto id = static_cast<std::int64_t>(reader.next(1)[0]);
      const auto place = std::lower_bound(ids.begin(), ids.end(), id);
      faces.corners.push_back(static_cast<std::int32_t>(place - ids.begin()));
    }
    ++faces.count;
    // Offsets are stored from the first face on that is not a triangle.
    if (are_triangles && corners != 3) {
      for (std::uint64_t face = 1; face < faces.count; ++face) ends.push_back(static_cast<std::int64_t>(3 * face));
      are_triangles = false;
    }
    if (!are_triangles) ends.push_back(static_cast<std::int64_t>(faces.corners.size()));
  }
  if (!are_triangles) faces.offsets = std::move(ends);
  return faces;
}

template <class T>
void write_array(const std::filesystem::path& file, std::span<const T> values) {
  io::FileWriter writer(file);
  writer.write(io::npy_header(io::npy_type<T>(), fmt::format("({},)", values.size())));
  writer.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  writer.commit();
}

template <class Real>
std::vector<Real> positions_of(std::span<const Site> vertices) {
  std::vector<Real> xyz;
  xyz.reserve(3 * vertices.size());
  for (const Site& vertex : vertices) {
    for (const double x : {vertex.position.x, vertex.position.y, vertex.position.z})
      xyz.push_back(static_cast<Real>(x));
  }
  return xyz;
}

/// The ids of all vertices, and the numbers of those that the part owns.
struct Numbering {
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owned;
};

Numbering number_vertices(std::span<const Site> vertices, const CutTree& tree, std::size_t part) {
  Numbering result;
  result.ids.reserve(vertices.size());
  for (const Site& vertex : vertices) {
    if (tree.owner(vertex) == part) result.owned.push_back(static_cast<std::int32_t>(result.ids.size()));
    result.ids.push_back(static_cast<std::int64_t>(vertex.id));
  }
  return result;
}

template <class Real>
void write_index(const std::filesystem::path& file, std::vector<Real> xyz, const Faces& faces, const Run& run) {
  const Index index = build({PositionsView(xyz), faces.view()}, run);
  std::vector<Real>().swap(xyz);
  io::save(file, index, {}, {.progress = run.progress});
}

void check_count(std::size_t vertices, std::size_t part) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (vertices <= kMost) return;
  raise(ErrorCode::TooLarge, fmt::format("part {} has {} vertices with its halo, but the limit is {}: use more parts",
                                         part, vertices, kMost));
}

}  // namespace

std::array<std::uint64_t, 4> vertex_words(const Site& vertex) {
  return {vertex.id, std::bit_cast<std::uint64_t>(vertex.position.x), std::bit_cast<std::uint64_t>(vertex.position.y),
          std::bit_cast<std::uint64_t>(vertex.position.z)};
}

std::uint64_t part_memory(const PartContents& contents, std::size_t part) {
  // Measured on surfaces, and rounded up: tests/parts/memory_test.cpp.
  constexpr std::uint64_t kBytesPerVertex = 250;
  constexpr std::uint64_t kBytesPerFaceWord = 8;
  return contents.vertices.size(part) / kVertexWords * kBytesPerVertex + contents.faces.size(part) * kBytesPerFaceWord;
}

Part write_part_files(const std::filesystem::path& folder, const PartContents& contents, std::size_t number,
                      const CutTree& tree, bool is_double, const Run& run) {
  std::vector<Site> vertices = read_vertices(contents.vertices, number);
  check_count(vertices.size(), number);
  const Numbering numbering = number_vertices(vertices, tree, number);
  std::variant<std::vector<float>, std::vector<double>> xyz;
  is_double ? xyz = positions_of<double>(vertices) : xyz = positions_of<float>(vertices);
  std::vector<Site>().swap(vertices);
  const Faces faces = read_faces(contents.faces, number, numbering.ids);

  std::visit([&](auto& values) { write_index(folder / kIndexFile, std::move(values), faces, run); }, xyz);
  write_array<std::int64_t>(folder / kVerticesFile, numbering.ids);
  write_array<std::int32_t>(folder / kOwnedFile, numbering.owned);
  write_array<std::int32_t>(folder / kCornersFile, faces.corners);
  write_array<std::int64_t>(folder / kOffsetsFile, faces.offsets);
  Part part{.vertices = numbering.ids.size(), .owned = numbering.owned.size(), .faces = faces.count, .files = {}};
  for (const std::string_view name : {kIndexFile, kVerticesFile, kOwnedFile, kCornersFile, kOffsetsFile}) {
    part.files.push_back(describe_file(folder, name));
  }
  return part;
}

}  // namespace meshhood::parts
