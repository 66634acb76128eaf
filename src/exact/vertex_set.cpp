// SPDX-License-Identifier: MIT
#include "exact/vertex_set.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace meshhood {

void VertexSet::assign(std::span<const LeafSubset> subsets) {
  clear();
  sorted_.assign(subsets.begin(), subsets.end());
  std::sort(sorted_.begin(), sorted_.end(), [](const LeafSubset& a, const LeafSubset& b) { return a.leaf < b.leaf; });
  for (std::size_t i = 0; i < sorted_.size();) {
    LeafSubset all = sorted_[i];
    while (++i < sorted_.size() && sorted_[i].leaf == all.leaf) all.lanes |= sorted_[i].lanes;
    add_lanes(all);
  }
}

void VertexSet::align_to_leaves() {
  sorted_.clear();
  for_each([&](std::size_t v) {
    if (sorted_.empty() || v >= index_->leaf_begin[sorted_.back().leaf + 1]) {
      sorted_.push_back({leaf_of(index_->slot[index_->id(v)]), 0});
    }
    sorted_.back().lanes |= LaneMask{1} << (v - index_->leaf_begin[sorted_.back().leaf]);
  });
  clear();
  for (const LeafSubset& subset : sorted_) add_lanes(subset);
}

void VertexSet::assign_difference(const VertexSet& all, const VertexSet& part) {
  clear();
  auto taken = part.parts().begin();
  for (Part rest : all.parts()) {
    const auto is_taken = [&] { return taken != part.parts().end() && taken->begin < rest.end; };
    if (rest.is_run()) {
      for (; is_taken(); ++taken) {
        if (rest.begin < taken->begin) add(VertexRange{rest.begin, taken->begin});
        const LaneMask left = first_lanes(taken->end - taken->begin) & ~taken->lanes;
        if (!taken->is_run()) add(Part{taken->begin, taken->end, left});
        rest.begin = taken->end;
      }
      if (rest.begin < rest.end) add(VertexRange{rest.begin, rest.end});
    } else {
      for (; is_taken(); ++taken) rest.lanes &= ~taken->lanes;
      if (rest.lanes != 0) add(rest);
    }
  }
}

std::span<const VertexRange> VertexSet::ranges() {
  ranges_.clear();
  const auto append = [&](VertexId begin, VertexId end) {
    if (!ranges_.empty() && ranges_.back().end == begin) {
      ranges_.back().end = end;
    } else {
      ranges_.push_back({begin, end});
    }
  };
  for (const Part& part : parts()) {
    if (part.is_run()) {
      append(part.begin, part.end);
      continue;
    }
    for (std::uint64_t left = part.lanes; left != 0;) {
      const auto begin = static_cast<unsigned>(std::countr_zero(left));
      const auto end = begin + static_cast<unsigned>(std::countr_one(left >> begin));
      append(static_cast<VertexId>(part.begin + begin), static_cast<VertexId>(part.begin + end));
      left = left >> end << end;
    }
  }
  return ranges_;
}

}  // namespace meshhood
