// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/patch.h"
#include "meshhood/surface.h"

#include "about.h"
#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"
#include "pool.h"

namespace nb = nanobind;

// Calls for one region keep the interpreter lock: they are short.
namespace meshhood::python {
namespace {

/// Points of a surface in memory of NumPy, a column for each property. Made with the interpreter lock.
class SurfaceColumns {
 public:
  explicit SurfaceColumns(std::size_t rows)
      : distances_(rows, "float64"),
        faces_(rows, "int64"),
        corners_(rows, "int32", 3),
        barycentric_(rows, "float64", 3),
        points_(rows, "float64", 3) {}

  /// On any thread. `corners`: of its triangle.
  void set(std::size_t row, const SurfacePoint& found, const std::array<VertexId, 3>& corners) {
    static_assert(static_cast<std::int64_t>(kNoFace) == -1);
    distances_.values[row] = found.distance;
    faces_.values[row] = static_cast<std::int64_t>(found.face);
    corners_.values[row] = corners;
    barycentric_.values[row] = found.barycentric;
    points_.values[row] = found.point;
  }

  /// Distances, faces, the corners of their triangles, barycentric coordinates and points.
  [[nodiscard]] auto arrays() const {
    return std::tuple(distances_.array, faces_.array, corners_.array, barycentric_.array, points_.array);
  }

 private:
  template <class Value>
  struct Column {
    nanobind::object array;
    std::span<Value> values;

    Column(std::size_t rows, const char* dtype, std::size_t columns = 0)
        : array(unset(rows, dtype, columns)), values(values_of<Value>(array)) {}
  };

  Column<double> distances_;
  Column<std::int64_t> faces_;
  Column<std::array<VertexId, 3>> corners_;
  Column<std::array<double, 3>> barycentric_;
  Column<SpacePoint> points_;
};

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
  return owned<double>(without_lock([&] {
    if (call.points) return thickness(surface, call.faces(), call.face_points(), method, run);
    return thickness(surface, call.query().vertices, method, run);
  }));
}

/// Not a copy: the array keeps the surface alive, and may not be written to.
Output<const double> areas_of(const nb::object& self) {
  const auto& surface = nb::cast<const Surface&>(self);
  const std::span<const double> areas = without_lock([&] { return surface.vertex_areas(); });
  return {areas.data(), {areas.size()}, self};
}

auto submesh(const Surface& surface, const Ids& ids, bool all) {
  Submesh part = surface.submesh(ids_of(ids), all ? Corners::All : Corners::Any);
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

/// A surface for any number of threads at the same time, with searchers for single starts.
class SharedSurface : public Surface {
  /// A vertex, or a face and a point of it.
  using Place = std::variant<VertexId, std::pair<std::size_t, SpacePoint>>;

  /// Calls `f(searcher, start)`.
  template <class F>
  auto ask(const Place& place, F&& f) {
    const auto* const on_face = std::get_if<1>(&place);
    const PatchStart start =
        on_face != nullptr ? PatchStart(on_face->first, on_face->second) : PatchStart(std::get<0>(place));
    return searchers_.with([&] { return PatchSearcher(*this); },
                           [&](PatchSearcher& searcher) { return f(searcher, start); });
  }

 public:
  explicit SharedSurface(Surface surface) : Surface(std::move(surface)) {}

  [[nodiscard]] auto measure_rows(const Call& call) const {
    const Run run = call.run();
    Invariants found = without_lock([&] {
      if (!call.points) return invariants(*this, call.query(), run);
      return invariants(*this, call.faces(), call.face_points(), call.query().radius, run);
    });
    return std::pair(owned<double>(std::move(found.area)), owned<double>(std::move(found.volume)));
  }

  [[nodiscard]] auto find_gaps(const Call& call) const {
    const BatchQuery query = call.query();
    const Run run = call.run();
    SurfaceColumns columns(query.result_rows(call.points ? call.face_points().size() : vertex_count()));
    const auto set = [&](std::size_t row, const SurfacePoint& gap) { columns.set(row, gap, gap.vertices); };
    without_lock([&] {
      if (!call.points) return for_each_gap(*this, query, set, run);
      const std::vector<SurfacePoint> found = gaps(*this, call.faces(), call.face_points(), query.radius, run);
      for (std::size_t row = 0; row < found.size(); ++row) set(row, found[row]);
    });
    return columns.arrays();
  }

  auto find_patch(const Place& place, double radius) {
    const std::vector<std::size_t> found =
        ask(place, [&](PatchSearcher& searcher, const PatchStart& start) { return searcher.patch(start, radius); });
    return owned<std::int64_t>(std::vector<std::int64_t>(found.begin(), found.end()));
  }

  /// Points, the three vertices and weights of each, faces, triangles and the area.
  auto clip(const Place& place, double radius, double tolerance) {
    ClippedMesh part = ask(place, [&](PatchSearcher& searcher, const PatchStart& start) {
      return searcher.clip(start, radius, tolerance);
    });
    const std::size_t points = part.points.size();
    const std::size_t triangles = part.triangles.size();
    return std::tuple(owned<double>(std::move(part.points), {points, 3}),
                      owned<std::int32_t>(std::move(part.vertices), {points, 3}),
                      owned<double>(std::move(part.weights), {points, 3}), owned<std::int64_t>(std::move(part.faces)),
                      owned<std::int32_t>(std::move(part.triangles), {triangles, 3}), part.area);
  }

  auto measure(const Place& place, double radius) {
    const PatchMeasure found =
        ask(place, [&](PatchSearcher& searcher, const PatchStart& start) { return searcher.measure(start, radius); });
    return std::pair(found.area, found.volume);
  }

  /// One row of `find_gaps`.
  auto find_gap(const Place& place, double radius) {
    const SurfacePoint found =
        ask(place, [&](PatchSearcher& searcher, const PatchStart& start) { return searcher.gap(start, radius); });
    SurfaceColumns columns(1);
    columns.set(0, found, found.vertices);
    return columns.arrays();
  }

 private:
  Pool<PatchSearcher> searchers_;
};

SharedSurface of_faces(const ExactMethod& method, const Faces& given) {
  const FacesView faces = faces_of(given);
  return SharedSurface(without_lock([&] { return Surface(method.index(), faces); }));
}

SharedSurface of_normals(const ExactMethod& method, const Reals& normals, const std::optional<Faces>& given) {
  const FacesView faces = given ? faces_of(*given) : FacesView{};
  return SharedSurface(without_lock([&] {
    return about("normals", [&] { return Surface::of_normals(method.index(), numbers_of(normals), faces); });
  }));
}

}  // namespace

nb::class_<Surface> bind_surface(nb::module_& module) {
  module.def("surface_of_faces", &of_faces);
  module.def("surface_of_normals", &of_normals, nb::arg(), nb::arg(), nb::arg("faces").none());
  nb::class_<Surface> surface(module, "Surface");
  surface.def_prop_ro("face_count", &Surface::face_count)
      .def("paths",
           [](const Surface& surface) { return exact_method(without_lock([&] { return surface_paths(surface); })); })
      .def("on",
           [](const Surface& whole, const ExactMethod& method) { return SharedSurface(whole.on(method.index())); })
      .def("refit",
           [](Surface& surface, const ExactMethod& method, const Ids& changed) {
             without_lock([&] { surface.refit_in_place(method.index(), ids_of(changed)); });
           })
      .def("vertex_areas", &areas_of, nb::rv_policy::reference)
      .def("closest", &closest_points, nb::arg(), nb::arg("threads"), nb::arg("progress").none())
      .def("first_hits", &first_hits, nb::arg(), nb::arg(), nb::arg("threads"), nb::arg("progress").none())
      .def("thickness", &measure_thickness, nb::arg(), nb::arg("by_sphere"))
      .def("submesh", &submesh)
      .def("rim", &rim);
  nb::class_<SharedSurface, Surface>(module, "SharedSurface")
      .def("invariants", &SharedSurface::measure_rows)
      .def("gaps", &SharedSurface::find_gaps)
      .def("patch", &SharedSurface::find_patch)
      .def("clip", &SharedSurface::clip)
      .def("measure", &SharedSurface::measure)
      .def("gap", &SharedSurface::find_gap);
  return surface;
}

}  // namespace meshhood::python
