// SPDX-License-Identifier: MIT
// The union of several regions, one flood after the other.
#include <string>
#include <utility>

#include "base/distance.h"
#include "exact/query/region_state.h"

namespace meshhood {

void RegionSearcher::stroke(std::span<const Dab> dabs, std::vector<VertexId>& out, const Filter& filter) {
  State& state = *state_;
  for (std::size_t i = 0; i < dabs.size(); ++i) {
    const std::string where = "dab " + std::to_string(i) + ": ";
    state.check(dabs[i].start, where);
    check_radius(dabs[i].radius, where);
  }
  state.check(filter);
  VertexSet all(*state.index);
  std::vector<LaneMask>& seen = state.seen;
  seen.assign(state.index->leaf_count(), 0);
  for (const Dab& dab : dabs) {
    state.begin(dab.start, filter);
    state.flood.grow(dab.radius);
    state.for_each_found(0, [&](const LeafSubset& subset) {
      const LaneMask lanes = subset.lanes & ~seen[subset.leaf];  // mutant: stroke-lists-vertices-twice
      seen[subset.leaf] |= subset.lanes;
      if (lanes != 0) all.add(LeafSubset{subset.leaf, lanes});
    });
  }
  state.answer = std::move(all);
  state.write_ids_to(out);
}

}  // namespace meshhood
