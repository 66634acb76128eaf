// SPDX-License-Identifier: MIT
#include "exact/search/component.h"

#include <cstddef>
#include <cstdint>

namespace meshhood::inline v0_1 {

void Component::complete(Reach& reach, VertexSet& answer) {
  if (!marks_.open_groups().empty() || !marks_.open_places().empty()) open_.unite(reach, marks_);
  answer.make_room(kFanOut * reach.groups().size());
  std::size_t place = 0;
  for (const std::uint32_t group : reach.groups().first(reach.top_groups().size())) {
    add_group(group, reach, place, answer);
  }
}

/// Adds what a group has of the component in index order. `place` is that of the next surface leaf.
void Component::add_group(std::uint32_t group, const Reach& reach, std::size_t& place, VertexSet& answer) const {
  const GroupState& state = reach.states()[group];
  const GroupRecord& record = index_->records[group];
  for_each_node(static_cast<NodeSet>(state.marked | state.intersecting), [&](unsigned i) {
    const unsigned is_marked = state.marked >> i & 1U;
    if (index_->is_of_leaves(group)) {
      // There are no branches, because they could not be predicted.
      const LaneMask lanes = marks_.lanes(place) & (is_marked - 1U);
      answer.add_if(is_marked != 0 || lanes != 0, run_of(record, i), lanes);
      place += 1U - is_marked;
    } else if (is_marked != 0) {
      answer.add(run_of(record, i));
    } else {
      add_group(record.first_child + i, reach, place, answer);
    }
  });
}

}  // namespace meshhood::inline v0_1
