// SPDX-License-Identifier: MIT
// The union of several regions, one flood after the other.
#include <string>
#include <utility>

#include "exact/query/region_state.h"
#include "exact/vertex_set.h"
#include "shared/distance.h"

namespace meshhood {

void RegionSearcher::stroke(std::span<const Dab> dabs, std::vector<VertexId>& out, const Filter& filter) {
  State& state = *state_;
  for (std::size_t i = 0; i < dabs.size(); ++i) {
    const std::string where = "dab " + std::to_string(i) + ": ";
    state.check(dabs[i].start, where);
    check_radius(dabs[i].radius, where);
  }
  state.check(filter);
  std::vector<LeafSubset>& found = state.found;
  found.clear();
  for (const Dab& dab : dabs) {
    state.begin(dab.start, filter);
    state.flood.grow(dab.radius);
    state.for_each_found(0, [&](const LeafSubset& subset) { found.push_back(subset); });
  }
  state.answer.assign(found);
  replace_ids(state.answer, *state.index, *state.kernels, out);
}

}  // namespace meshhood
