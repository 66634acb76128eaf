// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/error.h"
#include "meshhood/features.h"
#include "meshhood/moments.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

auto curvatures_of(const Surface& surface, const Call& call, bool libigl, bool jet, bool filter) {
  CurvatureOptions options = libigl ? like_libigl() : CurvatureOptions{};
  options.fit = jet ? CurvatureFit::Jet : CurvatureFit::Quadric;
  options.filter = filter;
  const Run run = call.run();
  const BatchQuery query = call.query();
  const std::size_t rows = query.result_rows(surface.vertex_count());
  const nb::object k1 = unset(rows, "float64");
  const nb::object k2 = unset(rows, "float64");
  // In one block: glibc gives memory back to the system, which costs page faults in the next call, as soon as more than
  // twice the largest block is free. It always does so beyond 32 MiB.
  const nb::object directions = unset(6 * rows, "float64");
  const nb::object state = unset(rows, "uint8");
  const nb::object count = unset(rows, "uint32");
  const CurvatureMemory memory{values_of<double>(k1),
                               values_of<double>(k2),
                               values_of<double>(directions).first(3 * rows),
                               values_of<double>(directions).subspan(3 * rows),
                               values_of<CurvatureState>(state),
                               values_of<std::uint32_t>(count)};
  without_lock([&] { curvatures(surface, query, memory, options, run); });
  const nb::object vectors = directions.attr("reshape")(2, rows, 3);
  return std::tuple(k1, k2, nb::object(vectors[0]), nb::object(vectors[1]), state, count);
}

auto corrected_curvatures_of(const Surface& surface, const Call& call) {
  const Run run = call.run();
  CorrectedCurvatures found = without_lock([&] { return corrected_curvatures(surface, call.query(), run); });
  const std::size_t rows = found.area.size();
  return std::tuple(owned<double>(std::move(found.area)), owned<double>(std::move(found.mean)),
                    owned<double>(std::move(found.gaussian)), owned<double>(std::move(found.k1)),
                    owned<double>(std::move(found.k2)), owned<double>(std::move(found.d1), {rows, 3}),
                    owned<double>(std::move(found.d2), {rows, 3}),
                    owned<double>(std::move(found.measures), {rows, CorrectedCurvatures::kMeasures}));
}

Output<double> moments_of(const ExactMethod& method, const Call& call, unsigned degree,
                          const std::optional<Reals>& weights) {
  const MomentOptions options{.degree = degree, .weights = numbers_of(weights)};
  const Run run = call.run();
  std::vector<double> found = without_lock([&] { return moments(method.index(), call.query(), options, run); });
  const std::size_t columns = moment_count(degree);
  const std::size_t rows = found.size() / columns;
  return owned<double>(std::move(found), {rows, columns});
}

auto components_of(const ExactMethod& method, const Call& call, const std::optional<Reals>& weights) {
  const MomentOptions options{.degree = 0, .weights = numbers_of(weights)};
  const Run run = call.run();
  PrincipalComponents found =
      without_lock([&] { return principal_components(method.index(), call.query(), options, run); });
  const std::size_t rows = found.weight.size();
  return std::tuple(owned<double>(std::move(found.weight)), owned<double>(std::move(found.center), {rows, 3}),
                    owned<double>(std::move(found.variances), {rows, 3}),
                    owned<double>(std::move(found.axes), {rows, 3, 3}));
}

/// Calls `f`. An error of a radius names the argument `scales` if that has it; the module names `r`.
template <class F>
auto about_radii(const BatchRadius& radius, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidRadius || !radius.scales()) throw;
    raise(ErrorCode::InvalidOption, std::string("scales: ") + error.what());
  }
}

Output<double> features_of(const Surface& surface, const Call& call, std::vector<Feature> kinds, bool filter) {
  const BatchQuery query = call.query();
  const FeatureOptions options{.kinds = std::move(kinds), .areas = {}, .filter = filter};
  const Run run = call.run();
  std::vector<double> found =
      without_lock([&] { return about_radii(query.radius, [&] { return features(surface, query, options, run); }); });
  const std::size_t rows = found.size() / options.kinds.size();
  return owned<double>(std::move(found), {rows, options.kinds.size()});
}

auto persistence_of(const Reals& values, const Reals& radii, double threshold) {
  Persistence found = without_lock([&] { return persistence(numbers_of(values), numbers_of(radii), threshold); });
  return std::tuple(owned<std::int32_t>(std::move(found.scales)), owned<double>(std::move(found.strength)),
                    owned<double>(std::move(found.radius)));
}

double radius_of_libigl(const Mesh& given, double edges) {
  const MeshView mesh = mesh_of(given);
  return without_lock([&] { return libigl_radius(mesh, edges); });
}

}  // namespace

void bind_curvature(nb::module_& module, nb::class_<Surface>& surface) {
  nb::enum_<Feature>(module, "Feature")
      .value("crease", Feature::Crease)
      .value("mean", Feature::Mean)
      .value("gaussian", Feature::Gaussian)
      .value("k1", Feature::K1)
      .value("k2", Feature::K2)
      .value("curvedness", Feature::Curvedness)
      .value("shape_index", Feature::ShapeIndex)
      .value("area", Feature::Area)
      .value("volume", Feature::Volume)
      .value("gap", Feature::Gap)
      .value("height", Feature::Height)
      .value("variation", Feature::Variation);
  surface.def("curvature", &curvatures_of, nb::arg(), nb::arg("libigl"), nb::arg("jet"), nb::arg("filter"))
      .def("corrected_curvature", &corrected_curvatures_of)
      .def("features", &features_of, nb::arg(), nb::arg("kinds"), nb::arg("filter"));
  module.def("moments", &moments_of, nb::arg(), nb::arg(), nb::arg("degree"), nb::arg("weights").none());
  module.def("principal_components", &components_of, nb::arg(), nb::arg(), nb::arg("weights").none());
  module.def("persistence", &persistence_of, nb::arg("values"), nb::arg("radii"), nb::arg("threshold"));
  module.def(
      "geometric_radii",
      [](double smallest, double largest, std::size_t count) {
        return owned<double>(geometric_radii(smallest, largest, count));
      },
      nb::arg("smallest"), nb::arg("largest"), nb::arg("count"));
  module.def("libigl_radius", &radius_of_libigl, nb::arg(), nb::arg("edges"));
}

}  // namespace meshhood::python
