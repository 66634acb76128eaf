// SPDX-License-Identifier: MIT
// What the Python package meshhood is made from: conversions, and the interpreter lock. Arguments have been checked and
// converted by meshhood/_convert.py.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "meshhood/error.h"

#include "arrays.h"
#include "data.h"
#include "io/mesh_io.h"
#include "methods.h"
#include "watch.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

template <class T>
using Output = nb::ndarray<nb::numpy, T>;

using Rows = nb::ndarray<const std::int32_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using Radii = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

PyObject* python_type(ErrorCode code) {
  switch (code) {
    case ErrorCode::IoFailure: return PyExc_OSError;
    case ErrorCode::Cancelled: return PyExc_KeyboardInterrupt;
    default: return PyExc_ValueError;
  }
}

/// The argument that an error of a query is about.
const char* argument_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::VertexOutOfRange: return "v: ";
    case ErrorCode::InvalidRadius: return "r: ";
    default: return "";
  }
}

void translate(const std::exception_ptr& exception, void*) {
  try {
    std::rethrow_exception(exception);
  } catch (const Error& error) {
    PyErr_SetString(python_type(error.code()), (std::string(argument_of(error.code())) + error.what()).c_str());
  }
}

FacesView faces_of(const Input& corners, const std::optional<Input>& offsets) {
  const IndicesView flat = indices_of(corners, "F");
  return offsets ? FacesView::polygons(indices_of(*offsets, "F"), flat) : FacesView::triangles(flat);
}

std::shared_ptr<Data> make_data(const Input& positions, const Input& corners, const std::optional<Input>& offsets) {
  const MeshView mesh{positions_of(positions, "V"), faces_of(corners, offsets)};
  const nb::gil_scoped_release unlocked;
  return std::make_shared<Data>(mesh);
}

std::shared_ptr<ExactMethod> make_exact(const Data& data, unsigned threads, nb::handle progress) {
  const BuildOptions options{.threads = threads, .progress = watch(progress)};
  const nb::gil_scoped_release unlocked;
  return exact_method(data, options);
}

Output<std::int32_t> one(Method& method, VertexId v, double radius) {
  Answer answer;
  {
    const nb::gil_scoped_release unlocked;
    answer = method.neighborhood(v, radius, false);
  }
  return owned<std::int32_t>(std::move(answer.ids));
}

auto one_with_distances(Method& method, VertexId v, double radius) {
  Answer answer;
  {
    const nb::gil_scoped_release unlocked;
    answer = method.neighborhood(v, radius, true);
  }
  return std::pair(owned<std::int32_t>(std::move(answer.ids)), owned<double>(std::move(answer.distances)));
}

BatchQuery query_of(const std::optional<Rows>& vertices, const std::variant<double, Radii>& radius) {
  BatchQuery query;
  if (vertices) query.vertices = {reinterpret_cast<const VertexId*>(vertices->data()), vertices->size()};
  if (const auto* const radii = std::get_if<Radii>(&radius)) {
    query.radius = std::span(radii->data(), radii->size());
  } else {
    query.radius = std::get<double>(radius);
  }
  return query;
}

auto many(Method& method, const std::optional<Rows>& vertices, const std::variant<double, Radii>& radius,
          bool distances, bool sorted, unsigned threads, nb::handle progress) {
  const BatchQuery query = query_of(vertices, radius);
  const BatchOptions options{.threads = threads, .distances = distances, .sorted = sorted, .progress = watch(progress)};
  Neighborhoods rows;
  {
    const nb::gil_scoped_release unlocked;
    rows = method.neighborhoods(query, options);
  }
  return std::tuple(owned<std::int64_t>(std::move(rows.offsets)), owned<std::int32_t>(std::move(rows.ids)),
                    owned<double>(std::move(rows.distances)));
}

Output<std::int64_t> many_counts(Method& method, const std::optional<Rows>& vertices,
                                 const std::variant<double, Radii>& radius, unsigned threads, nb::handle progress) {
  const BatchQuery query = query_of(vertices, radius);
  const BatchOptions options{.threads = threads, .progress = watch(progress)};
  std::vector<std::uint64_t> counts;
  {
    const nb::gil_scoped_release unlocked;
    counts = method.counts(query, options);
  }
  return owned<std::int64_t>(std::move(counts));
}

Output<std::int32_t> ranges(ExactMethod& method, VertexId v, double radius) {
  static_assert(sizeof(VertexRange) == 2 * sizeof(std::int32_t));
  std::vector<VertexRange> ranges;
  {
    const nb::gil_scoped_release unlocked;
    ranges = method.ranges(v, radius);
  }
  const std::size_t size = ranges.size();
  return owned<std::int32_t>(std::move(ranges), {size, 2});
}

/// Not a copy: the array keeps the index alive, and may not be written to.
nb::ndarray<nb::numpy, const std::int32_t> permutation(const nb::object& self) {
  const auto ids = nb::cast<ExactMethod&>(self).index().permutation();
  return {reinterpret_cast<const std::int32_t*>(ids.data()), {ids.size()}, self};
}

/// Positions (#V by 3), corners, offsets (empty where all are triangles), warnings.
auto read(const std::filesystem::path& path) {
  io::Mesh mesh;
  {
    const nb::gil_scoped_release unlocked;
    mesh = io::read_mesh(path);
  }
  nb::object positions = std::visit(
      [](auto& xyz) {
        using Real = typename std::decay_t<decltype(xyz)>::value_type;
        const std::size_t size = xyz.size() / 3;
        return nb::cast(owned<Real>(std::move(xyz), {size, 3}));
      },
      mesh.positions);
  std::vector<std::string> warnings;
  warnings.reserve(mesh.warnings.size());
  for (const auto& [what, count, place] : mesh.warnings) {
    std::string& warning = warnings.emplace_back(place);
    warning.append(": ").append(what);
    if (count > 1) warning.append(" (").append(std::to_string(count)).append(" times)");
  }
  return std::tuple(std::move(positions), owned<std::uint32_t>(std::move(mesh.corners)),
                    owned<std::int64_t>(std::move(mesh.offsets)), std::move(warnings));
}

void bind_methods(nb::module_& module) {
  nb::class_<Method>(module, "Method")
      .def("neighborhood", &one, nb::arg(), nb::arg())
      .def("neighborhood_and_distances", &one_with_distances, nb::arg(), nb::arg())
      .def("count", &Method::count, nb::arg(), nb::arg(), nb::call_guard<nb::gil_scoped_release>())
      .def("neighborhoods", &many, nb::arg().none(), nb::arg(), nb::arg("distances"), nb::arg("sorted"),
           nb::arg("threads"), nb::arg("progress").none())
      .def("counts", &many_counts, nb::arg().none(), nb::arg(), nb::arg("threads"), nb::arg("progress").none());
  nb::class_<ExactMethod, Method>(module, "ExactMethod")
      .def("ranges", &ranges, nb::arg(), nb::arg())
      .def_prop_ro("permutation", &permutation)
      .def_prop_ro("nbytes", [](const ExactMethod& method) { return method.index().bytes().total(); });
}

void bind_makers(nb::module_& module) {
  nb::class_<Data>(module, "Data").def_prop_ro("vertex_count", [](const Data& data) {
    return data.positions().size();
  });
  module.def("data", &make_data, nb::arg(), nb::arg(), nb::arg("offsets").none());
  module.def("exact", &make_exact, nb::arg(), nb::arg("threads"), nb::arg("progress").none());
  module.def("paper", &paper_method, nb::call_guard<nb::gil_scoped_release>());
  module.def("bfs", [](std::shared_ptr<Data> data) { return bfs_method(std::move(data)); });
  module.def("ball", [](std::shared_ptr<Data> data) { return ball_method(std::move(data)); });
  module.def("read_mesh", &read, nb::arg("path"));
}

}  // namespace
}  // namespace meshhood::python

NB_MODULE(_core, module) {
  nb::register_exception_translator(meshhood::python::translate);
  meshhood::python::bind_methods(module);
  meshhood::python::bind_makers(module);
}
