// SPDX-License-Identifier: MIT
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>

#include "meshhood/curvature.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

CurvatureIndex of_faces(const ExactMethod& method, const Input& corners, const std::optional<Input>& offsets) {
  const IndicesView flat = indices_of(corners, "F");
  const FacesView faces = offsets ? FacesView::polygons(indices_of(*offsets, "F"), flat) : FacesView::triangles(flat);
  return without_lock([&] { return CurvatureIndex::build(method.index(), faces); });
}

CurvatureIndex of_normals(const ExactMethod& method, const Radii& normals) {
  const std::span<const double> values(normals.data(), normals.size());
  return without_lock([&] { return CurvatureIndex::build(method.index(), values); });
}

auto curvatures_of(const CurvatureIndex& surface, const std::optional<Rows>& vertices,
                   const std::variant<double, Radii>& radius, bool libigl, bool filter, unsigned threads,
                   nb::handle progress) {
  CurvatureOptions options = libigl ? like_libigl() : CurvatureOptions{};
  options.filter = filter;
  options.threads = threads;
  options.progress = progress_to(progress);
  const BatchQuery query = query_of(vertices, radius);
  Curvatures found = without_lock([&] { return curvatures(surface, query, options); });
  const std::size_t rows = found.state.size();
  return std::tuple(owned<double>(std::move(found.k1)), owned<double>(std::move(found.k2)),
                    owned<double>(std::move(found.d1), {rows, 3}), owned<double>(std::move(found.d2), {rows, 3}),
                    owned<std::uint8_t>(std::move(found.state)));
}

double radius_of_libigl(const Input& positions, const Input& corners, const std::optional<Input>& offsets,
                        double edges) {
  const IndicesView flat = indices_of(corners, "F");
  const FacesView faces = offsets ? FacesView::polygons(indices_of(*offsets, "F"), flat) : FacesView::triangles(flat);
  const MeshView mesh{positions_of(positions, "V"), faces};
  return without_lock([&] { return libigl_radius(mesh, edges); });
}

}  // namespace

void bind_curvature(nb::module_& module) {
  nb::class_<CurvatureIndex>(module, "Surface")
      .def("curvatures", &curvatures_of, nb::arg().none(), nb::arg(), nb::arg("libigl"), nb::arg("filter"),
           nb::arg("threads"), nb::arg("progress").none());
  module.def("surface_of_faces", &of_faces, nb::arg(), nb::arg(), nb::arg("offsets").none());
  module.def("surface_of_normals", &of_normals, nb::arg(), nb::arg());
  module.def("libigl_radius", &radius_of_libigl, nb::arg(), nb::arg(), nb::arg("offsets").none(), nb::arg("edges"));
}

}  // namespace meshhood::python
