// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
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
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>

#include "meshhood/masks.h"
#include "meshhood/refit.h"

#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

Output<std::int32_t> one(Method& method, VertexId v, double radius) {
  Answer answer = method.neighborhood(v, radius, false);
  return owned<std::int32_t>(std::move(answer.ids));
}

auto one_with_distances(Method& method, VertexId v, double radius) {
  Answer answer = method.neighborhood(v, radius, true);
  return std::pair(owned<std::int32_t>(std::move(answer.ids)), owned<double>(std::move(answer.distances)));
}

auto many(Method& method, const std::optional<Ids>& vertices, const Radius& radius, bool distances, bool sorted,
          unsigned threads, std::uint64_t max_bytes, nb::handle progress) {
  const BatchQuery query = query_of(vertices, radius);
  const BatchOptions options{.distances = distances, .sorted = sorted};
  const Run run{.threads = threads, .progress = progress_to(progress), .max_bytes = max_bytes};
  FoundRows found;
  const BatchAllocator allocate = found.allocator(distances);
  std::vector<std::uint64_t> offsets = limited("iter_neighborhoods returns the rows in chunks",
                                               [&] { return method.neighborhoods(query, allocate, options, run); });
  return std::tuple(owned<std::int64_t>(std::move(offsets)), std::move(found.ids), std::move(found.distances));
}

Output<std::int64_t> many_counts(Method& method, const std::optional<Ids>& vertices, const Radius& radius,
                                 unsigned threads, nb::handle progress) {
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return owned<std::int64_t>(method.counts(query_of(vertices, radius), run));
}

/// A value for each vertex, 0 or 1.
using Mask = std::optional<Bytes>;

/// Borrows the array.
VertexMask mask_of(const Mask& mask) { return mask ? VertexMask(std::span(mask->data(), mask->size())) : VertexMask(); }

std::shared_ptr<ExactMethod> masked_method(const ExactMethod& method, const Mask& walls, const Mask& ignored) {
  const Masks masks{mask_of(walls), mask_of(ignored)};
  return exact_method(without_lock([&] { return masked(method.index(), masks); }));
}

bool are_same_masks(const Mask& a, const Mask& b) {
  const auto bytes = [](const Mask& mask) {
    return mask ? std::span(mask->data(), mask->size()) : std::span<const std::uint8_t>();
  };
  return a.has_value() == b.has_value() && std::ranges::equal(bytes(a), bytes(b));
}

/// Not a copy: the array keeps the index alive, and may not be written to.
Output<const std::int32_t> permutation(const nb::object& self) {
  const Index& index = nb::cast<ExactMethod&>(self).index();
  const auto ids = index.permutation();
  if (ids.size() == index.vertex_count())
    return {reinterpret_cast<const std::int32_t*>(ids.data()), {ids.size()}, self};
  // The index of a mesh that was reordered has none.
  std::vector<VertexId> all(index.vertex_count());
  std::iota(all.begin(), all.end(), VertexId{0});
  return owned<const std::int32_t>(std::move(all));
}

/// Not copies: the arrays keep the index alive, and may not be written to.
Output<const std::uint32_t> array_of(const IndicesView& indices, const nb::object& self) {
  return indices.visit([&](auto values) -> Output<const std::uint32_t> {
    return {reinterpret_cast<const std::uint32_t*>(values.data()), {values.size()}, self};
  });
}

/// Corners and offsets, none of which for triangles; nothing if the index has no faces.
auto stored_faces(const nb::object& self) {
  using Corners = Output<const std::uint32_t>;
  std::optional<std::pair<Corners, std::optional<Corners>>> result;
  const std::optional<FacesView> found = nb::cast<ExactMethod&>(self).index().faces();
  if (!found) return result;
  result.emplace(array_of(found->corners(), self), std::nullopt);
  if (!found->are_triangles()) result->second = array_of(found->offsets(), self);
  return result;
}

}  // namespace

void bind_methods(nb::module_& module) {
  nb::class_<Method>(module, "Method")
      .def("neighborhood", &one, nb::arg(), nb::arg())
      .def("neighborhood_and_distances", &one_with_distances, nb::arg(), nb::arg())
      .def("count", &Method::count, nb::arg(), nb::arg())
      .def("neighborhoods", &many, nb::arg().none(), nb::arg(), nb::arg("distances"), nb::arg("sorted"),
           nb::arg("threads"), nb::arg("max_bytes"), nb::arg("progress").none())
      .def("counts", &many_counts, nb::arg().none(), nb::arg(), nb::arg("threads"), nb::arg("progress").none());
  module.def("are_same_masks", &are_same_masks, nb::arg().none(), nb::arg().none());
  nb::class_<ExactMethod, Method>(module, "ExactMethod")
      .def("masked", &masked_method, nb::arg("walls").none(), nb::arg("ignored").none())
      .def("quality",
           [](const ExactMethod& method) {
             const Quality found = without_lock([&] { return quality(method.index()); });
             return std::tuple(found.mean_radius, found.rebuilt_radius, found.gain);
           })
      .def_prop_ro("permutation", &permutation, nb::rv_policy::reference)
      .def_prop_ro("faces", &stored_faces, nb::rv_policy::reference)
      .def_prop_ro("vertex_count", [](const ExactMethod& method) { return method.index().vertex_count(); })
      .def_prop_ro("nbytes", [](const ExactMethod& method) { return method.index().bytes().total(); });
}

}  // namespace meshhood::python
