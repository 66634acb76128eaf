// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/surface.h"
#include "meshhood/thickness.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"
#include "surface_columns.h"

namespace nb = nanobind;

// Calls for one region keep the interpreter lock: they are short.
namespace meshhood::python {
namespace {

Corners corners_of(bool all) { return all ? Corners::All : Corners::Any; }

Surface of_faces(const ExactMethod& method, const Faces& given) {
  const FacesView faces = faces_of(given);
  return without_lock([&] { return Surface(method.index(), faces); });
}

/// With an index of its own.
Surface of_mesh(const Mesh& given) {
  const MeshView mesh = mesh_of(given);
  return without_lock([&] {
    const Index index = build(mesh);
    return Surface(index, mesh.faces);
  });
}

Surface of_normals(const ExactMethod& method, const Reals& normals, const std::optional<Faces>& given) {
  const FacesView faces = given ? faces_of(*given) : FacesView{};
  return without_lock([&] { return Surface::of_normals(method.index(), numbers_of(normals), faces); });
}

/// The columns of the points that `find(visit)` visits, with the places of corners in the face.
template <class Find>
auto columns(std::size_t rows, const Find& find) {
  SurfaceColumns columns(rows);
  without_lock([&] {
    find([&](std::size_t row, const SurfacePoint& found) {
      std::array<VertexId, 3> places;
      std::ranges::transform(found.corners, places.begin(), [](std::size_t c) { return static_cast<VertexId>(c); });
      columns.set(row, found, places);
    });
  });
  return columns.arrays();
}

auto closest_points(const Surface& surface, const Points& points, unsigned threads, nb::handle progress) {
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return columns(points.shape(0), [&](const SurfacePointVisitor& visit) {
    surface.for_each_closest_point(points_of(points), visit, run);
  });
}

auto first_hits(const Surface& surface, const Points& origins, const Points& directions, unsigned threads,
                nb::handle progress) {
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return columns(origins.shape(0), [&](const SurfacePointVisitor& visit) {
    surface.for_each_first_hit(points_of(origins), points_of(directions), visit, run);
  });
}

Output<double> measure_thickness(const Surface& surface, const Call& call, bool by_sphere) {
  const Run run = call.run();
  const ThicknessMethod method = by_sphere ? ThicknessMethod::Sphere : ThicknessMethod::Ray;
  return owned<double>(without_lock([&] { return thickness(surface, call.query().vertices, method, run); }));
}

Output<std::int64_t> faces(const Surface& surface, const Ids& ids, bool all) {
  return owned<std::int64_t>(surface.faces(ids_of(ids), corners_of(all)));
}

auto submesh(const Surface& surface, const Ids& ids, bool all) {
  Submesh part = surface.submesh(ids_of(ids), corners_of(all));
  return std::tuple(owned<std::int32_t>(std::move(part.vertices)), owned<std::int64_t>(std::move(part.faces)),
                    owned<std::int64_t>(std::move(part.offsets)), owned<std::int32_t>(std::move(part.corners)));
}

auto rim(const Surface& surface, const Ids& ids, const SpacePoint& center, double radius) {
  Rim rim = surface.rim(ids_of(ids), center, radius);
  const std::size_t size = rim.points.size();
  return std::tuple(owned<double>(std::move(rim.points), {size, 3}),
                    owned<std::int32_t>(std::move(rim.edges), {size, 2}), owned<std::int64_t>(std::move(rim.offsets)),
                    owned<std::uint8_t>(std::move(rim.closed)));
}

}  // namespace

nb::class_<Surface> bind_surface(nb::module_& module) {
  module.def("surface_of_faces", &of_faces);
  module.def("surface_of_mesh", &of_mesh);
  module.def("surface_of_normals", &of_normals, nb::arg(), nb::arg(), nb::arg("faces").none());
  nb::class_<Surface> surface(module, "Surface");
  surface.def_prop_ro("face_count", &Surface::face_count)
      .def("paths",
           [](const Surface& surface) { return exact_method(without_lock([&] { return surface_paths(surface); })); })
      .def("on", [](const Surface& whole, const ExactMethod& method) { return whole.on(method.index()); })
      .def("closest", &closest_points, nb::arg(), nb::arg("threads"), nb::arg("progress").none())
      .def("first_hits", &first_hits, nb::arg(), nb::arg(), nb::arg("threads"), nb::arg("progress").none())
      .def("thickness", &measure_thickness, nb::arg(), nb::arg("by_sphere"))
      .def("faces", &faces)
      .def("submesh", &submesh)
      .def("rim", &rim);
  return surface;
}

}  // namespace meshhood::python
