// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/serialize.h"

#include "about.h"
#include "arrays.h"
#include "bindings.h"
#include "interpreter.h"
#include "io/file_writer.h"
#include "io/index_io.h"
#include "io/mesh_io.h"
#include "io/vertex_properties.h"
#include "io/weld.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// scalar_bytes  the size of a coordinate; 0: as the file says.
/// Returns positions (#V by 3), corners, offsets (empty if all faces are triangles) and warnings.
auto read(const std::filesystem::path& path, std::size_t scalar_bytes, unsigned threads, nb::handle progress) {
  const io::Precision precision = scalar_bytes == 0               ? io::Precision::FromFile
                                  : scalar_bytes == sizeof(float) ? io::Precision::Float
                                                                  : io::Precision::Double;
  const io::ReadOptions options{.precision = precision, .threads = threads, .progress = progress_to(progress)};
  io::Mesh mesh = without_lock([&] { return io::read_mesh(path, options); });
  check_vertex_count(mesh.view().positions.size());
  nb::object positions = std::visit(
      [&walls = mesh.walls](auto& xyz) {
        using Real = typename std::decay_t<decltype(xyz)>::value_type;
        for (std::size_t v = 0; v < walls.size(); ++v) {  // as in the file; an index makes them walls again
          if (walls[v] != 0) std::fill_n(&xyz[3 * v], 3, std::numeric_limits<Real>::quiet_NaN());
        }
        return owned_positions(std::move(xyz));
      },
      mesh.positions);
  std::vector<std::string> warnings(mesh.warnings.size());
  std::ranges::transform(mesh.warnings, warnings.begin(), &io::Warning::text);
  return std::tuple(std::move(positions), owned<std::int32_t>(std::move(mesh.corners)),
                    owned<std::int64_t>(std::move(mesh.offsets)), std::move(warnings));
}

using Scalars = nb::ndarray<const float, nb::c_contig, nb::device::cpu>;
using Colors = nb::ndarray<const std::uint8_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// Named scalars (#V) or vectors (#V by 3).
using NamedScalars = std::vector<std::pair<std::string, Scalars>>;

std::vector<io::VertexProperty> properties_of(const NamedScalars& values) {
  std::vector<io::VertexProperty> properties;
  properties.reserve(values.size());
  for (const auto& [name, numbers] : values) {
    properties.push_back({name, std::span(numbers.data(), numbers.size())});
  }
  return properties;
}

/// `walls`: of those without a position, as `place` returns them.
void write(const std::filesystem::path& path, const Mesh& given, const NamedScalars& values,
           const std::optional<Colors>& colors, const std::optional<Bytes>& walls, bool vtk) {
  const MeshView mesh = mesh_of(given);
  const std::vector<io::VertexProperty> properties = properties_of(values);
  const Progress progress = progress_to(nb::handle(Py_None));
  without_lock([&] {
    if (vtk)
      return io::write_vtk(path, mesh, {.properties = properties, .walls = bytes_of(walls), .progress = progress});
    io::PlyOptions options{.properties = properties, .walls = bytes_of(walls), .progress = progress};
    if (colors) options.colors = std::span(colors->data(), colors->size());
    io::write_ply(path, mesh, options);
  });
}

/// Returns positions (#kept by 3), corners, offsets (empty for triangles), and the new id of each vertex.
auto weld(const Mesh& given, double eps) {
  const MeshView mesh = mesh_of(given);
  io::WeldedMesh welded = without_lock([&] {
    about("V", [&] {
      validate(mesh.positions);
      check_vertex_count(mesh.positions.size());
    });
    return about("F", [&] { return io::weld(mesh, eps); });
  });
  nb::object kept = std::visit([](auto& xyz) { return owned_positions(std::move(xyz)); }, welded.positions);
  return std::tuple(std::move(kept), owned<std::int32_t>(std::move(welded.corners)),
                    owned<std::int64_t>(std::move(welded.offsets)), owned<std::int32_t>(std::move(welded.ids)));
}

/// `faces`: to be saved with the index.
void save_file(const ExactMethod& method, const std::filesystem::path& path, const std::optional<Faces>& faces,
               nb::handle progress) {
  SaveOptions options;
  const Run run{.progress = progress_to(progress)};
  if (faces) options.faces = faces_of(*faces);
  without_lock([&] { io::save(path, method.index(), options, run); });
}

std::shared_ptr<ExactMethod> loaded(Index index) {
  check_vertex_count(index.vertex_count());
  return exact_method(std::move(index));
}

/// `trusted` applies to mapped files only.
std::shared_ptr<ExactMethod> load_file(const std::filesystem::path& path, bool mmap, bool trusted,
                                       nb::handle progress) {
  const Run run{.progress = progress_to(progress)};
  return without_lock([&] {
    if (mmap) return loaded(io::map(path, {.trusted = trusted}, run));
    return loaded(io::load(path, run));
  });
}

Output<std::uint8_t> to_bytes(const ExactMethod& method) {
  const Run run{.progress = progress_to(nb::handle(Py_None))};
  std::vector<std::byte> bytes;
  const Sink append = [&](std::span<const std::byte> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); };
  without_lock([&] {
    bytes.reserve(method.index().bytes().total());
    save(method.index(), append, {}, run);
  });
  return owned<std::uint8_t>(std::move(bytes));
}

/// A file that appears when the block of a `with` statement ends, as `MeshIndex.save` writes its file; after an
/// exception an old file is unchanged. NumPy and zipfile call `tell` and `flush`.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : writer_(std::make_unique<io::FileWriter>(path)) {}

  [[nodiscard]] std::uint64_t position() const { return writer().position(); }
  void seek(std::uint64_t position) { writer().seek(position); }
  /// Any array, as its bytes. Returns their number.
  std::size_t write(const Input& array) {
    const std::string_view text(static_cast<const char*>(array.data()), array.nbytes());
    without_lock([&] { writer().write(text); });
    return text.size();
  }
  OpenFile& enter() { return *this; }
  void exit(nb::handle exception, nb::handle, nb::handle) {
    const std::unique_ptr<io::FileWriter> writer = std::move(writer_);
    if (writer && exception.is_none()) without_lock([&] { writer->commit(); });
  }

 private:
  [[nodiscard]] io::FileWriter& writer() const {
    if (!writer_) throw nb::value_error("the file is closed");
    return *writer_;
  }

  std::unique_ptr<io::FileWriter> writer_;
};

std::shared_ptr<ExactMethod> from_bytes(const Bytes& bytes) {
  const auto all = std::as_bytes(std::span(bytes.data(), bytes.size()));
  const Run run{.progress = progress_to(nb::handle(Py_None))};
  return without_lock([&] { return loaded(load(all, run)); });
}

}  // namespace

void bind_files(nb::module_& module) {
  module.def("write_mesh", &write, nb::arg(), nb::arg(), nb::arg("values"), nb::arg("colors").none(),
             nb::arg("walls").none(), nb::arg("vtk"));
  module.def("check_values",
             [](const NamedScalars& values, std::size_t vertices, const std::vector<std::string>& taken) {
               io::check_properties(properties_of(values), vertices, {taken.begin(), taken.end()});
             });
  module.def("weld", &weld, nb::arg(), nb::arg("eps"));
  module.def("read_mesh", &read, nb::arg("path"), nb::arg("scalar_bytes"), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("save", &save_file, nb::arg(), nb::arg("path"), nb::arg("faces").none(), nb::arg("progress").none());
  module.def("load", &load_file, nb::arg("path"), nb::arg("mmap"), nb::arg("trusted"), nb::arg("progress").none());
  module.def("to_bytes", &to_bytes);
  nb::class_<OpenFile>(module, "FileWriter")
      .def(nb::init<const std::filesystem::path&>())
      .def("tell", &OpenFile::position)
      .def("flush", [](const OpenFile&) {})
      .def("seek", &OpenFile::seek)
      .def("write", &OpenFile::write, nb::sig("def write(self, data: typing.Any, /) -> int"))
      .def("__enter__", &OpenFile::enter, nb::rv_policy::reference)
      .def("__exit__", &OpenFile::exit, nb::arg().none(), nb::arg().none(), nb::arg().none());
  module.def("from_bytes", &from_bytes);
}

}  // namespace meshhood::python
