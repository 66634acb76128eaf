// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/patch.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"
#include "pool.h"
#include "surface_columns.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// The surface of an index, with searchers for single starts.
class Patches {
  /// Calls `f(searcher, start)` for a vertex, or a point of a face.
  template <class F>
  auto ask(VertexId vertex, std::optional<std::size_t> face, const SpacePoint& point, F&& f) {
    const PatchStart start = face ? PatchStart(*face, point) : PatchStart(vertex);
    return searchers_.with([&] { return PatchSearcher(surface_); },
                           [&](PatchSearcher& searcher) { return f(searcher, start); });
  }

 public:
  explicit Patches(Surface surface) : surface_(std::move(surface)) {}

  [[nodiscard]] auto measure_rows(const Call& call) const {
    const Run run = call.run();
    Invariants found = without_lock([&] { return invariants(surface_, call.query(), run); });
    return std::pair(owned<double>(std::move(found.area)), owned<double>(std::move(found.volume)));
  }

  [[nodiscard]] auto find_gaps(const Call& call) const {
    const BatchQuery query = call.query();
    const Run run = call.run();
    SurfaceColumns columns(query.result_rows(surface_.vertex_count()));
    without_lock([&] {
      const auto set = [&](std::size_t row, const SurfacePoint& gap) { columns.set(row, gap, gap.vertices); };
      for_each_gap(surface_, query, set, run);
    });
    return columns.arrays();
  }

  auto faces(VertexId vertex, std::optional<std::size_t> face, const SpacePoint& point, double radius) {
    const std::vector<std::size_t> found =
        ask(vertex, face, point,
            [&](PatchSearcher& searcher, const PatchStart& start) { return searcher.patch(start, radius); });
    return owned<std::int64_t>(std::vector<std::int64_t>(found.begin(), found.end()));
  }

  /// Points, the three vertices and weights of each, faces, triangles and the area.
  auto clip(VertexId vertex, std::optional<std::size_t> face, const SpacePoint& point, double radius,
            double tolerance) {
    ClippedMesh part = ask(vertex, face, point, [&](PatchSearcher& searcher, const PatchStart& start) {
      return searcher.clip(start, radius, tolerance);
    });
    const std::size_t points = part.points.size();
    const std::size_t triangles = part.triangles.size();
    return std::tuple(owned<double>(std::move(part.points), {points, 3}),
                      owned<std::int32_t>(std::move(part.vertices), {points, 3}),
                      owned<double>(std::move(part.weights), {points, 3}), owned<std::int64_t>(std::move(part.faces)),
                      owned<std::int32_t>(std::move(part.triangles), {triangles, 3}), part.area);
  }

  auto measure(VertexId vertex, std::optional<std::size_t> face, const SpacePoint& point, double radius) {
    const PatchMeasure found = ask(vertex, face, point, [&](PatchSearcher& searcher, const PatchStart& start) {
      return searcher.measure(start, radius);
    });
    return std::pair(found.area, found.volume);
  }

  /// One row of `find_gaps`.
  auto find_gap(VertexId vertex, std::optional<std::size_t> face, const SpacePoint& point, double radius) {
    const SurfacePoint found = ask(vertex, face, point, [&](PatchSearcher& searcher, const PatchStart& start) {
      return searcher.gap(start, radius);
    });
    SurfaceColumns columns(1);
    columns.set(0, found, found.vertices);
    return columns.arrays();
  }

 private:
  Surface surface_;
  Pool<PatchSearcher> searchers_;
};

auto make_patches(const ExactMethod& method, const Surface& surface) {
  return std::make_unique<Patches>(surface.on(method.index()));
}

}  // namespace

void bind_patches(nb::module_& module) {
  nb::class_<Patches>(module, "Patches")
      .def("invariants", &Patches::measure_rows)
      .def("gaps", &Patches::find_gaps)
      .def("faces", &Patches::faces, nb::arg("vertex"), nb::arg("face").none(), nb::arg("point"), nb::arg("radius"))
      .def("clip", &Patches::clip, nb::arg("vertex"), nb::arg("face").none(), nb::arg("point"), nb::arg("radius"),
           nb::arg("tolerance"))
      .def("measure", &Patches::measure, nb::arg("vertex"), nb::arg("face").none(), nb::arg("point"), nb::arg("radius"))
      .def("gap", &Patches::find_gap, nb::arg("vertex"), nb::arg("face").none(), nb::arg("point"), nb::arg("radius"));
  module.def("patches", &make_patches);
}

}  // namespace meshhood::python
