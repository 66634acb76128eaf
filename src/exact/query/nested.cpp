// SPDX-License-Identifier: MIT
// The regions of one start for several radii: the neighborhoods of a vertex, or else one flood that grows from each
// radius to the next.
#include <cstddef>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "exact/query/region_state.h"
#include "exact/vertex_set.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood {
namespace {

void check_radii(std::span<const double> radii) {
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::string where = "radii: value " + std::to_string(i) + ": ";
    check_radius(radii[i], where);
    if (i == 0 || radii[i - 1] < radii[i]) continue;
    raise(ErrorCode::InvalidRadius,
          where + "radius " + to_text(radii[i]) + ", expected more than " + to_text(radii[i - 1]) + " before it");
  }
}

}  // namespace

bool RegionSearcher::nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& out,
                            std::vector<std::size_t>& counts) {
  State& state = *state_;
  state.check(start);
  check_radii(radii);
  std::vector<std::size_t> sizes;
  sizes.reserve(radii.size());
  std::vector<VertexId> ids;
  const auto append = [&](const VertexSet& ring) {
    append_ids(ring, *state.index, *state.kernels, ids);
    sizes.push_back(ids.size());
  };
  if (State::is_neighborhood(start)) {
    SearcherAccess::State& searcher = state.searcher();
    VertexSet before(*state.index);
    for (const double radius : radii) {
      searcher.search(start.vertex(), radius);
      state.answer.assign_difference(searcher.answer, before);
      append(state.answer);
      std::swap(before, searcher.answer);
    }
  } else {
    state.begin(start);
    for (const double radius : radii) {
      const std::size_t before = state.flood.reached().size();
      state.flood.grow(radius);
      state.collect_found(before);
      append(state.answer);
    }
  }
  const bool has_seed = radii.empty() || state.has_seed(start, radii.back());
  out = std::move(ids);  // which may be the seeds
  counts = std::move(sizes);
  return has_seed;
}

}  // namespace meshhood
