// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/k_nearest.h"
#include "meshhood/masks.h"
#include "meshhood/refit.h"
#include "meshhood/search.h"
#include "meshhood/start.h"
#include "meshhood/unconnected.h"

#include "about.h"
#include "arrays.h"
#include "batch_query.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

Output<std::int32_t> one(Method& method, VertexId v, double radius) {
  return owned<std::int32_t>(method.with_searcher([&](auto& searcher) {
    std::vector<VertexId> ids;
    searcher.neighborhood(v, radius, ids);
    return ids;
  }));
}

auto one_with_distances(Method& method, VertexId v, double radius) {
  std::vector<double> distances;
  std::vector<VertexId> found = method.with_searcher([&](auto& searcher) {
    std::vector<VertexId> ids;
    searcher.neighborhood(v, radius, ids, distances);
    return ids;
  });
  return std::pair(owned<std::int32_t>(std::move(found)), owned<double>(std::move(distances)));
}

std::size_t count_of_one(Method& method, VertexId v, double radius) {
  return method.with_searcher([&](auto& searcher) { return searcher.count(v, radius); });
}

using SeedRows = nb::ndarray<const std::int32_t, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;

/// The center of a point, or none: then the start is the vertex `seeds[0]`.
using Center = std::optional<SpacePoint>;

Start start_of(const Center& center, const Ids& seeds) {
  const std::span<const VertexId> ids = ids_of(seeds);
  return center ? Start(*center, ids) : Start(ids.front());
}

// Of an exact method, by any metric.

/// Also returns whether a seed lies in the ball, as `stroke` and `nested` do.
auto region(Method& method, const Center& center, const Ids& seeds, double radius) {
  const Start start = start_of(center, seeds);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  const bool has_seed = method.with_exact_searcher([&](Searcher& searcher) {
    searcher.neighborhood(start, radius, ids, distances);
    return searcher.has_seed(start, radius);
  });
  return std::tuple(owned<std::int32_t>(std::move(ids)), owned<double>(std::move(distances)), has_seed);
}

/// By vertices if there are no centers: then they are the seeds of the rows. Seeds that do not exist are -1.
auto stroke(Method& method, const std::optional<Points>& centers, const SeedRows& seeds, const Reals& radii) {
  const std::span all_seeds(reinterpret_cast<const VertexId*>(seeds.data()), seeds.size());
  std::vector<Dab> dabs;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::span row = all_seeds.subspan(i * seeds.shape(1), seeds.shape(1));
    const std::span existing(row.begin(), std::ranges::find(row, kNoVertex));
    const Start start = centers ? Start(points_of(*centers)[i], existing) : Start(row.front());
    dabs.push_back({start, radii.data()[i]});
  }
  std::vector<VertexId> ids;
  const bool has_seeds = method.with_exact_searcher([&](Searcher& searcher) {
    searcher.stroke(dabs, ids);
    return std::ranges::all_of(dabs, [&](const Dab& dab) { return searcher.has_seed(dab.start, dab.radius); });
  });
  return std::pair(owned<std::int32_t>(std::move(ids)), has_seeds);
}

auto nested(Method& method, const Center& center, const Ids& seeds, const Reals& radii) {
  const Start start = start_of(center, seeds);
  std::vector<VertexId> ids;
  std::vector<std::size_t> counts;
  const bool has_seed = method.with_exact_searcher([&](Searcher& searcher) {
    searcher.nested(start, numbers_of(radii), ids, counts);
    return radii.size() == 0 || searcher.has_seed(start, radii.data()[radii.size() - 1]);
  });
  return std::tuple(owned<std::int64_t>(std::move(counts)), owned<std::int32_t>(std::move(ids)), has_seed);
}

bool contains(Method& method, const Center& center, const Ids& seeds, VertexId w, double radius) {
  return method.with_exact_searcher(
      [&](Searcher& searcher) { return searcher.contains(start_of(center, seeds), w, radius); });
}

double connecting_radius(Method& method, const Center& center, const Ids& seeds, VertexId w) {
  return method.with_exact_searcher(
      [&](Searcher& searcher) { return searcher.connecting_radius(start_of(center, seeds), w); });
}

auto nearest_connected(Method& method, const Center& center, const Ids& seeds, std::size_t k) {
  std::vector<VertexId> ids;
  std::vector<double> radii;
  method.with_exact_searcher([&](Searcher& searcher) {
    searcher.nearest_connected(start_of(center, seeds), k, ids, radii);
    return true;
  });
  return std::pair(owned<std::int32_t>(std::move(ids)), owned<double>(std::move(radii)));
}

auto nearest_vertices(ExactMethod& method, const Points& points, unsigned threads, nb::handle progress) {
  const Run run{.threads = threads, .progress = progress_to(progress)};
  std::vector<VertexId> ids;
  std::vector<double> distances;
  without_lock([&] {
    for (const auto& [vertex, distance] : nearest(method.index(), points_of(points), run)) {
      ids.push_back(vertex);
      distances.push_back(distance);
    }
  });
  return std::pair(owned<std::int32_t>(std::move(ids)), owned<double>(std::move(distances)));
}

/// Rows in memory of NumPy.
struct FoundRows {
  nb::object ids;
  nb::object distances;

  /// Allocates both, or the ids alone. Called with the interpreter lock; the result without it, on the same thread.
  [[nodiscard]] BatchAllocator allocator(bool has_distances) {
    return [this, has_distances, state = PyThreadState_Get()](std::size_t count) {
      return with_lock(state, [&]() -> BatchMemory {
        ids = unset(count, "int32");
        distances = unset(has_distances ? count : 0, "float64");
        return {values_of<VertexId>(ids), values_of<double>(distances)};
      });
    };
  }
};

auto many(const Method& method, const Call& call, bool distances, RowSort sort) {
  const BatchOptions options{.distances = distances, .sort = sort};
  const Run run = call.run();
  FoundRows found;
  const BatchAllocator allocate = found.allocator(distances);
  std::vector<std::uint64_t> offsets = limited("iter_neighborhoods returns the rows in chunks", [&] {
    return without_lock([&] { return neighborhoods(method.search(), call.query(), allocate, options, run); });
  });
  return std::tuple(owned<std::int64_t>(std::move(offsets)), std::move(found.ids), std::move(found.distances));
}

Output<std::int64_t> many_counts(const Method& method, const Call& call) {
  const Run run = call.run();
  return owned<std::int64_t>(without_lock([&] { return counts(method.search(), call.query(), run); }));
}

auto unconnected(const ExactMethod& method, const Call& call) {
  const Run run = call.run();
  Unconnected found = without_lock([&] { return nearest_unconnected(method.index(), call.query(), run); });
  static_assert(static_cast<std::int32_t>(kNoVertex) == -1);
  return std::pair(owned<std::int32_t>(std::move(found.vertex)), owned<double>(std::move(found.distance)));
}

constexpr const char* kFewer = "take fewer vertices at a time";

/// The rows have one radius.
auto k_nearest_of(const ExactMethod& method, const Call& call, std::size_t k) {
  const BatchQuery query = call.query();
  const NearestOptions options{.metric = query.metric, .radius = query.radius.common()};
  const Run run = call.run();
  FoundRows found;
  const BatchAllocator allocate = found.allocator(true);
  limited(kFewer, [&] { without_lock([&] { k_nearest(method.index(), query.vertices, k, allocate, options, run); }); });
  const std::size_t rows = query.vertices.count(method.index().vertex_count());
  return std::pair(found.ids.attr("reshape")(rows, k), found.distances.attr("reshape")(rows, k));
}

/// The rows have one radius.
auto discs_of(const ExactMethod& method, const Call& call, double area, const Reals& areas) {
  const BatchQuery query = call.query();
  const NearestOptions options{.metric = query.metric, .radius = query.radius.common()};
  const Run run = call.run();
  Neighborhoods found = limited(kFewer, [&] {
    return without_lock([&] { return discs(method.index(), query.vertices, area, numbers_of(areas), options, run); });
  });
  return std::tuple(owned<std::int64_t>(std::move(found.offsets)), owned<std::int32_t>(std::move(found.ids)),
                    owned<double>(std::move(found.distances)));
}

/// A value for each vertex, 0 or 1.
using Mask = std::optional<Bytes>;

std::shared_ptr<ExactMethod> masked_method(const ExactMethod& method, const Mask& walls, const Mask& ignored) {
  const Masks masks{.walls = bytes_of(walls), .ignored = bytes_of(ignored)};
  return exact_method(without_lock([&] { return masked(method.index(), masks); }));
}

bool are_same_masks(const Mask& a, const Mask& b) {
  return a.has_value() == b.has_value() && std::ranges::equal(bytes_of(a), bytes_of(b));
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
  nb::enum_<Metric>(module, "Metric")
      .value("straight", Metric::Straight)
      .value("path", Metric::Path)
      .value("rings", Metric::Rings)
      .value("space", Metric::Space);
  nb::enum_<RowSort>(module, "RowSort")
      .value("none", RowSort::None)
      .value("id", RowSort::Id)
      .value("distance", RowSort::Distance);
  nb::class_<Call>(module, "Call")
      .def(nb::init<std::optional<Ids>, std::optional<FacePoints>, Radius, Metric, unsigned, nb::object,
                    std::uint64_t>(),
           nb::arg("vertices").none(), nb::arg("points").none(), nb::arg("radius"), nb::arg("metric"),
           nb::arg("threads"), nb::arg("progress").none(), nb::arg("max_bytes"));
  const auto center = nb::arg("center").none();
  const auto arg = nb::arg();
  nb::class_<Method>(module, "Method")
      .def("neighborhood", &one)
      .def("neighborhood_and_distances", &one_with_distances)
      .def("count", &count_of_one)
      .def("neighborhoods", &many, nb::arg(), nb::arg("distances"), nb::arg("sort"))
      .def("counts", &many_counts)
      .def("region", &region, center, arg, arg)
      .def("stroke", &stroke, center, arg, arg)
      .def("nested", &nested, center, arg, arg)
      .def("contains", &contains, center, arg, arg, arg)
      .def("connecting_radius", &connecting_radius, center, arg, arg)
      .def("nearest_connected", &nearest_connected, center, arg, arg);
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
      .def_prop_ro("nbytes", [](const ExactMethod& method) { return method.index().bytes().total(); })
      .def("nearest", &nearest_vertices, nb::arg(), nb::arg("threads") = 1, nb::arg("progress").none() = nb::none());
  module.def("nearest_unconnected", &unconnected);
  module.def("k_nearest", &k_nearest_of, nb::arg(), nb::arg(), nb::arg("k"));
  module.def("discs", &discs_of, nb::arg(), nb::arg(), nb::arg("area"), nb::arg("areas"));
}

}  // namespace meshhood::python
