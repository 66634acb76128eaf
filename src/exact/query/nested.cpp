// SPDX-License-Identifier: MIT
// The regions of one start for several radii: one flood that grows from each radius to the next.
#include <cstddef>
#include <string>

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
  state.begin(start, filter);
  std::vector<std::size_t> sizes;
  sizes.reserve(radii.size());
  for (const double radius : radii) {
    const std::size_t before = state.flood.reached().size();
    state.flood.grow(radius);
    state.add_found(before);
    sizes.push_back(state.answer.count());
  }
  state.write_ids_to(out);
  counts = std::move(sizes);
}

}  // namespace meshhood
