// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/search.h"
#include "meshhood/start.h"

#include "arrays.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

using SeedRows = nb::ndarray<const std::int32_t, nb::shape<-1, -1>, nb::c_contig, nb::device::cpu>;

/// The center of a point, or none: then the start is the vertex `seeds[0]`.
using Center = std::optional<SpacePoint>;

Start start_of(const Center& center, const Ids& seeds) {
  const std::span<const VertexId> ids = ids_of(seeds);
  return center ? Start(*center, ids) : Start(ids.front());
}

/// Also returns whether a seed lies in the ball, as `stroke` and `nested` do.
auto region(ExactMethod& method, Metric metric, const Center& center, const Ids& seeds, double radius) {
  const Start start = start_of(center, seeds);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  const bool has_seed = method.with(metric, [&](Searcher& searcher) {
    searcher.neighborhood(start, radius, ids, distances);
    return searcher.has_seed(start, radius);
  });
  return std::tuple(owned<std::int32_t>(std::move(ids)), owned<double>(std::move(distances)), has_seed);
}

/// By vertices if there are no centers: then they are the seeds of the rows. Seeds that do not exist are -1.
auto stroke(ExactMethod& method, Metric metric, const std::optional<Points>& centers, const SeedRows& seeds,
            const Reals& radii) {
  const std::span all_seeds(reinterpret_cast<const VertexId*>(seeds.data()), seeds.size());
  std::vector<Dab> dabs;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::span row = all_seeds.subspan(i * seeds.shape(1), seeds.shape(1));
    const std::span existing(row.begin(), std::ranges::find(row, kNoVertex));
    const Start start = centers ? Start(points_of(*centers)[i], existing) : Start(row.front());
    dabs.push_back({start, radii.data()[i]});
  }
  std::vector<VertexId> ids;
  const bool has_seeds = method.with(metric, [&](Searcher& searcher) {
    searcher.stroke(dabs, ids);
    return std::ranges::all_of(dabs, [&](const Dab& dab) { return searcher.has_seed(dab.start, dab.radius); });
  });
  return std::pair(owned<std::int32_t>(std::move(ids)), has_seeds);
}

auto nested(ExactMethod& method, Metric metric, const Center& center, const Ids& seeds, const Reals& radii) {
  const Start start = start_of(center, seeds);
  std::vector<VertexId> ids;
  std::vector<std::size_t> counts;
  const bool has_seed = method.with(metric, [&](Searcher& searcher) {
    searcher.nested(start, numbers_of(radii), ids, counts);
    return radii.size() == 0 || searcher.has_seed(start, radii.data()[radii.size() - 1]);
  });
  return std::tuple(owned<std::int64_t>(std::move(counts)), owned<std::int32_t>(std::move(ids)), has_seed);
}

bool contains(ExactMethod& method, Metric metric, const Center& center, const Ids& seeds, VertexId w, double radius) {
  return method.with(metric, [&](Searcher& searcher) { return searcher.contains(start_of(center, seeds), w, radius); });
}

double connecting_radius(ExactMethod& method, Metric metric, const Center& center, const Ids& seeds, VertexId w) {
  return method.with(metric,
                     [&](Searcher& searcher) { return searcher.connecting_radius(start_of(center, seeds), w); });
}

auto nearest_connected(ExactMethod& method, Metric metric, const Center& center, const Ids& seeds, std::size_t k) {
  std::vector<VertexId> ids;
  std::vector<double> radii;
  method.with(metric, [&](Searcher& searcher) {
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

}  // namespace

void bind_queries(nb::class_<ExactMethod, Method>& exact) {
  const auto center = nb::arg("center").none();
  const auto arg = nb::arg();
  exact.def("region", &region, arg, center, arg, arg)
      .def("stroke", &stroke, arg, center, arg, arg)
      .def("nested", &nested, arg, center, arg, arg)
      .def("contains", &contains, arg, center, arg, arg, arg)
      .def("connecting_radius", &connecting_radius, arg, center, arg, arg)
      .def("nearest_connected", &nearest_connected, arg, center, arg, arg)
      .def("nearest", &nearest_vertices, arg, nb::arg("threads") = 1, nb::arg("progress").none() = nb::none());
}

}  // namespace meshhood::python
