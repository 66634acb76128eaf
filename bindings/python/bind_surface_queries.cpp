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

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>

#include "meshhood/k_nearest.h"
#include "meshhood/unconnected.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

auto unconnected(const ExactMethod& method, const std::optional<Ids>& vertices, const Radius& radius, unsigned threads,
                 nb::handle progress, Metric metric) {
  const BatchQuery query = query_of(vertices, radius, metric);
  const Run run{.threads = threads, .progress = progress_to(progress)};
  Unconnected found = without_lock([&] { return nearest_unconnected(method.index(), query, run); });
  static_assert(static_cast<std::int32_t>(kNoVertex) == -1);
  return std::pair(owned<std::int32_t>(std::move(found.vertex)), owned<double>(std::move(found.distance)));
}

constexpr const char* kFewer = "take fewer vertices at a time";

auto k_nearest_of(const ExactMethod& method, const std::optional<Ids>& vertices, std::size_t k, std::int32_t fill,
                  Metric metric, double radius, unsigned threads, std::uint64_t max_bytes, nb::handle progress) {
  const BatchVertices asked = vertices_of(vertices);
  const NearestOptions options{.metric = metric, .radius = radius};
  const Run run{.threads = threads, .progress = progress_to(progress), .max_bytes = max_bytes};
  FoundRows found;
  const BatchAllocator allocate = found.allocator(true);
  limited(kFewer, [&] { without_lock([&] { k_nearest(method.index(), asked, k, allocate, options, run); }); });
  const std::span<VertexId> ids = values_of<VertexId>(found.ids);
  if (fill != -1) without_lock([&] { std::ranges::replace(ids, kNoVertex, static_cast<VertexId>(fill)); });
  const std::size_t rows = vertices ? vertices->size() : method.index().vertex_count();
  return std::pair(found.ids.attr("reshape")(rows, k), found.distances.attr("reshape")(rows, k));
}

auto discs_of(const ExactMethod& method, const std::optional<Ids>& vertices, double area, const Reals& areas,
              Metric metric, double radius, unsigned threads, std::uint64_t max_bytes, nb::handle progress) {
  const BatchVertices asked = vertices_of(vertices);
  const NearestOptions options{.metric = metric, .radius = radius};
  const Run run{.threads = threads, .progress = progress_to(progress), .max_bytes = max_bytes};
  Neighborhoods found = limited(kFewer, [&] {
    return without_lock([&] { return discs(method.index(), asked, area, numbers_of(areas), options, run); });
  });
  return std::tuple(owned<std::int64_t>(std::move(found.offsets)), owned<std::int32_t>(std::move(found.ids)),
                    owned<double>(std::move(found.distances)));
}

}  // namespace

void bind_surface_queries(nb::module_& module) {
  module.def("nearest_unconnected", &unconnected, nb::arg(), nb::arg().none(), nb::arg(), nb::arg("threads"),
             nb::arg("progress").none(), nb::arg("metric"));
  module.def("k_nearest", &k_nearest_of, nb::arg(), nb::arg().none(), nb::arg("k"), nb::arg("fill"), nb::arg("metric"),
             nb::arg("radius"), nb::arg("threads"), nb::arg("max_bytes"), nb::arg("progress").none());
  module.def("discs", &discs_of, nb::arg(), nb::arg().none(), nb::arg("area"), nb::arg("areas"), nb::arg("metric"),
             nb::arg("radius"), nb::arg("threads"), nb::arg("max_bytes"), nb::arg("progress").none());
}

}  // namespace meshhood::python
