// SPDX-License-Identifier: MIT
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/aggregate.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

using Values = nb::ndarray<const double, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;

/// A flat array, #scales by #rows by channels by #reductions.
nb::object aggregates(const ExactMethod& method, const Call& call, const Values& values,
                      const std::optional<Reals>& weights, std::vector<Reduce> reduce, SmoothingKernel kernel,
                      MissingValues missing, Nesting nesting, unsigned ddof, double quantile) {
  const SignalView signal{std::span(values.data(), values.size()), values.shape(1), numbers_of(weights)};
  const BatchQuery rows = call.query();
  const AggregateQuery query{.vertices = rows.vertices,
                             .radius = rows.radius,
                             .metric = rows.metric,
                             .reduce = std::move(reduce),
                             .kernel = kernel,
                             .missing = missing,
                             .nesting = nesting,
                             .ddof = ddof,
                             .quantile = quantile};
  const Run run = call.run();
  nb::object result = unset(aggregate_size(method.index(), signal, query, run), "float64");
  const std::span<double> numbers = values_of<double>(result);
  without_lock([&] { aggregate(method.index(), signal, query, numbers, run); });
  return result;
}

/// By distance, each with its radius.
Output<double> smoothing_weights(SmoothingKernel kernel, const Reals& distances, const Reals& radii) {
  std::vector<double> weights(distances.size());
  without_lock([&] {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = smoothing_weight(kernel, distances.data()[i], radii.data()[i]);
    }
  });
  return owned<double>(std::move(weights));
}

Output<double> areas(const Mesh& given) {
  const MeshView mesh = mesh_of(given);
  return owned<double>(without_lock([&] { return vertex_areas(mesh); }));
}

}  // namespace

void bind_aggregates(nb::module_& module) {
  nb::enum_<Reduce>(module, "Reduce")
      .value("sum", Reduce::Sum)
      .value("mean", Reduce::Mean)
      .value("min", Reduce::Minimum)
      .value("max", Reduce::Maximum)
      .value("var", Reduce::Variance)
      .value("std", Reduce::StandardDeviation)
      .value("count", Reduce::Count)
      .value("median", Reduce::Median)
      .value("quantile", Reduce::Quantile);
  nb::enum_<SmoothingKernel>(module, "SmoothingKernel")
      .value("box", SmoothingKernel::Box)
      .value("epanechnikov", SmoothingKernel::Epanechnikov)
      .value("biweight", SmoothingKernel::Biweight)
      .value("gaussian", SmoothingKernel::Gaussian);
  nb::enum_<MissingValues>(module, "MissingValues")
      .value("propagate", MissingValues::Propagate)
      .value("omit", MissingValues::Omit);
  nb::enum_<Nesting>(module, "Nesting").value("own", Nesting::Own).value("patch", Nesting::Patch);
  module.def("aggregate", &aggregates, nb::arg(), nb::arg(), nb::arg("values"), nb::arg("weights").none(),
             nb::arg("reduce"), nb::arg("kernel"), nb::arg("missing"), nb::arg("nesting"), nb::arg("ddof"),
             nb::arg("quantile"));
  module.def("vertex_areas", &areas);
  module.def("smoothing_radius", &smoothing_radius, nb::arg());
  module.def("smoothing_weights", &smoothing_weights, nb::arg("kernel"), nb::arg("distances"), nb::arg("radii"));
}

}  // namespace meshhood::python
