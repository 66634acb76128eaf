// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

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

constexpr std::uint64_t kMostNumbers = std::numeric_limits<std::int32_t>::max();  // of an array of faces

/// The length of the array of faces: of each the number of its corners, and the corners.
std::size_t numbers_of(const FacesView& faces) { return faces.size() + faces.corner_count(); }

/// The name as readers decode it.
std::string encoded(std::string_view name) {
  std::string result;
  for (const char c : name) result += c == '%' ? "%25" : std::string(1, c);
  return result;
}

/// Writes numbers as the format has them: big-endian.
class VtkWriter {
 public:
  VtkWriter(FileWriter& file, RowProgress& progress, const MeshView& mesh, const VtkOptions& options)
      : file_(file), progress_(progress), mesh_(mesh), options_(options) {}

  void write() {
    file_.write("# vtk DataFile Version 4.2\nmeshhood\nBINARY\nDATASET POLYDATA\n");
    mesh_.positions.visit([this](const auto& xyz) { write_points(xyz); });
    write_polygons();
    write_properties();
  }

 private:
  template <class T>
  void number(T value) {
    const auto bytes = stored(std::endian::big, value);
    file_.write({bytes.data(), bytes.size()});
  }

  template <class Real>
  void write_points(const StridedPositions<Real>& xyz) {
    file_.write(fmt::format("POINTS {} {}\n", xyz.size(), std::is_same_v<Real, double> ? "double" : "float"));
    for (std::size_t v = 0; v < xyz.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) number(written(xyz, v, axis, options_.walls));
      progress_.add_row();
    }
  }

  /// Some readers regard an empty list of polygons as damage.
  void write_polygons() {
    if (mesh_.faces.size() == 0) return;
    file_.write(fmt::format("\nPOLYGONS {} {}\n", mesh_.faces.size(), numbers_of(mesh_.faces)));
    mesh_.faces.for_each([this](std::size_t, std::span<const VertexId> corners) {
      number(static_cast<std::int32_t>(corners.size()));
      for (const VertexId v : corners) number(static_cast<std::int32_t>(v));
      progress_.add_row();
    });
  }

  /// The first scalar is the one that readers show at once; of several such sections, some read the first alone.
  void write_properties() {
    const std::size_t vertices = mesh_.positions.size();
    std::span<const VertexProperty> rest = options_.properties;
    file_.write(fmt::format("\nPOINT_DATA {}\n", vertices));
    if (!rest.empty() && components(rest.front(), vertices) == 1) {
      file_.write(fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", encoded(rest.front().name)));
      write_values(rest.front());
      rest = rest.subspan(1);
    }
    if (rest.empty()) return;
    file_.write(fmt::format("FIELD FieldData {}\n", rest.size()));
    for (const VertexProperty& property : rest) {
      file_.write(fmt::format("{} {} {} float\n", encoded(property.name), components(property, vertices), vertices));
      write_values(property);
    }
  }

  void write_values(const VertexProperty& property) {
    for (const float value : property.values) number(value);
    file_.write("\n");
    progress_.report();
  }

  FileWriter& file_;
  RowProgress& progress_;
  const MeshView& mesh_;
  const VtkOptions& options_;
};

}  // namespace

void write_vtk(const std::filesystem::path& path, const MeshView& mesh, const VtkOptions& options) {
  validate(mesh);
  check_walls(options.walls, mesh);
  check_properties(options.properties, mesh.positions.size());
  const std::uint64_t numbers = std::max(mesh.positions.size(), numbers_of(mesh.faces));
  const std::string name = path.string();
  if (numbers > kMostNumbers) {
    raise(ErrorCode::TooLarge, fmt::format("{}: {} vertices, or faces and corners, but the format has at most {}",
                                           printable_name(name), numbers, kMostNumbers));
  }
  RowProgress progress(options.progress, mesh.positions.size() + mesh.faces.size(), name);
  progress.report();
  const WhileWaiting waiting([&] { progress.report(); });
  FileWriter file(path);
  VtkWriter(file, progress, mesh, options).write();
  file.commit([&] { progress.report(); });
}

}  // namespace meshhood::inline v0_1::io
