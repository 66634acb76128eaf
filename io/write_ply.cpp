// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/binary.h"
#include "io/file_writer.h"
#include "io/mesh_io.h"
#include "io/messages.h"
#include "io/vertex_properties.h"
#include "io/waiting.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kColors = {"red", "green", "blue"};

/// The names of a property in the file: three for a vector.
std::vector<std::string> names_of(const VertexProperty& property, std::size_t vertices) {
  if (components(property, vertices) == 1) return {property.name};
  std::vector<std::string> names;
  names.reserve(kAxes.size());
  for (const auto axis : kAxes) names.push_back(fmt::format("{}_{}", property.name, axis));
  return names;
}

void check_names(const PlyOptions& options, std::size_t vertices) {
  std::vector<std::string> taken;
  for (const VertexProperty& property : options.properties) {
    for (std::string& name : names_of(property, vertices)) {
      if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
        raise(ErrorCode::InvalidOption,
              fmt::format("property {} occurs twice, once as a coordinate of a vector", quote(name)));
      }
      taken.push_back(std::move(name));
    }
  }
}

void check(const PlyOptions& options, std::size_t vertices) {
  std::vector<std::string_view> taken(kAxes.begin(), kAxes.end());
  if (!options.colors.empty()) {
    taken.insert(taken.end(), kColors.begin(), kColors.end());
    if (options.colors.size() != 3 * vertices) {
      raise(ErrorCode::InvalidOption,
            fmt::format("{} color values, expected three for each of {} vertices", options.colors.size(), vertices));
    }
  }
  check_properties(options.properties, vertices, std::move(taken));
  check_names(options, vertices);
}

std::size_t largest_face(const FacesView& faces) {
  std::size_t largest = 0;
  faces.for_each(
      [&largest](std::size_t, std::span<const VertexId> corners) { largest = std::max(largest, corners.size()); });
  return largest;
}

// Writes rows of values as lines of text or as little-endian bytes.
class Rows {
 public:
  Rows(FileWriter& file, RowProgress& progress, bool ascii) : file_(file), progress_(progress), ascii_(ascii) {}

  template <class T>
  void value(T value) {
    if (ascii_) {
      // The shortest text that parses to the same number. Not by fmt::format_to, which {fmt} 9 would compile here
      // again.
      if (!row_.empty()) row_ += ' ';
      row_ += fmt::format("{}", value);
    } else {
      const auto bytes = stored(std::endian::little, value);
      row_.append(bytes.data(), bytes.size());
    }
  }

  void end() {
    if (ascii_) row_ += '\n';
    file_.write(row_);
    row_.clear();
    progress_.add_row();
  }

 private:
  FileWriter& file_;
  RowProgress& progress_;
  bool ascii_;
  std::string row_;
};

class PlyWriter {
 public:
  PlyWriter(FileWriter& file, RowProgress& progress, const MeshView& mesh, const PlyOptions& options)
      : file_(file), rows_(file, progress, options.ascii), mesh_(mesh), options_(options) {}

  void write() {
    has_long_faces_ = largest_face(mesh_.faces) > std::numeric_limits<std::uint8_t>::max();
    file_.write(header());
    mesh_.positions.visit([this](const auto& xyz) { write_vertices(xyz); });
    mesh_.faces.for_each([this](std::size_t, std::span<const VertexId> corners) { write_face(corners); });
  }

 private:
  [[nodiscard]] std::string header() const {
    const auto scalar = mesh_.positions.visit(
        []<class Real>(const StridedPositions<Real>&) { return std::is_same_v<Real, double> ? "double" : "float"; });
    std::string text = "ply\n";
    text += options_.ascii ? "format ascii 1.0\n" : "format binary_little_endian 1.0\n";
    text += fmt::format("element vertex {}\n", mesh_.positions.size());
    for (const auto name : kAxes) text += fmt::format("property {} {}\n", scalar, name);
    if (!options_.colors.empty()) {
      for (const auto name : kColors) text += fmt::format("property uchar {}\n", name);
    }
    for (const auto& property : options_.properties) {
      for (const auto& name : names_of(property, mesh_.positions.size())) {
        text += fmt::format("property float {}\n", name);
      }
    }
    text += fmt::format("element face {}\n", mesh_.faces.size());
    text += fmt::format("property list {} {} vertex_indices\n", has_long_faces_ ? "uint" : "uchar", index_type());
    return text + "end_header\n";
  }

  // Most readers expect int.
  [[nodiscard]] std::string_view index_type() const {
    return mesh_.positions.size() > std::size_t{std::numeric_limits<std::int32_t>::max()} ? "uint" : "int";
  }

  template <class Real>
  void write_vertices(const StridedPositions<Real>& xyz) {
    for (std::size_t vertex = 0; vertex < xyz.size(); ++vertex) {
      for (std::size_t axis = 0; axis < 3; ++axis) rows_.value(written(xyz, vertex, axis, options_.walls));
      if (!options_.colors.empty()) {
        for (const auto channel : options_.colors.subspan(3 * vertex, 3)) rows_.value(channel);
      }
      for (const auto& property : options_.properties) {
        const std::size_t count = components(property, xyz.size());
        for (const float value : property.values.subspan(count * vertex, count)) rows_.value(value);
      }
      rows_.end();
    }
  }

  void write_face(std::span<const VertexId> corners) {
    if (has_long_faces_) {
      rows_.value(static_cast<std::uint32_t>(corners.size()));
    } else {
      rows_.value(static_cast<std::uint8_t>(corners.size()));
    }
    for (const VertexId corner : corners) rows_.value(static_cast<std::uint32_t>(corner));
    rows_.end();
  }

  FileWriter& file_;
  Rows rows_;
  const MeshView& mesh_;
  const PlyOptions& options_;
  bool has_long_faces_ = false;
};

}  // namespace

void write_ply(const std::filesystem::path& path, const MeshView& mesh, const PlyOptions& options) {
  validate(mesh);
  check_walls(options.walls, mesh);
  check(options, mesh.positions.size());
  RowProgress progress(options.progress, mesh.positions.size() + mesh.faces.size(), path.string());
  progress.report();
  const WhileWaiting waiting([&] { progress.report(); });
  FileWriter file(path);
  PlyWriter(file, progress, mesh, options).write();
  file.commit([&] { progress.report(); });
}

}  // namespace meshhood::inline v0_1::io
