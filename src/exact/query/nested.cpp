// SPDX-License-Identifier: MIT
// The regions of one start for several radii: the neighborhoods of a vertex, or else one flood that grows from each
// radius to the next.
#include <bit>
#include <cstddef>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "base/distance.h"
#include "base/text.h"
#include "exact/query/region_state.h"

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

void RegionSearcher::nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& out,
                            std::vector<std::size_t>& counts, const Filter& filter) {
  State& state = *state_;
  state.check(start);
  check_radii(radii);
  state.check(filter);
  std::vector<std::size_t> sizes;
  sizes.reserve(radii.size());
  if (const std::optional<VertexId> v = state.vertex_of(start);
      v && filter.walls.bytes().empty() && filter.ignored.bytes().empty()) {
    state.neighborhoods().run(*v, radii, out, sizes);
    counts = std::move(sizes);
    return;
  }
  state.begin(start, filter);
  std::size_t size = 0;
  for (const double radius : radii) {
    const std::size_t before = state.flood.reached().size();
    state.flood.grow(radius);
    state.for_each_found(before, [&](const LeafSubset& subset) {
      state.answer.add(subset);
      size += static_cast<std::size_t>(std::popcount(subset.lanes));
    });
    sizes.push_back(size);
  }
  state.write_ids_to(out);
  counts = std::move(sizes);
}

}  // namespace meshhood
