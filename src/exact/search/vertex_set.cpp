// SPDX-License-Identifier: MIT
#include "exact/search/vertex_set.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace meshhood {
void VertexSet::subtract(std::span<const LeafSubset> others) {
  if (others.empty()) return;
  for (LeafSubset& subset : subsets_) {
    const std::size_t i = find_from(others, index_->leaf_begin[subset.leaf]);
    if (i < others.size() && others[i].leaf == subset.leaf) subset.lanes &= ~others[i].lanes;
  }
  std::erase_if(subsets_, [](const LeafSubset& subset) { return subset.lanes == 0; });
  std::swap(runs_, whole_runs_);
  runs_.clear();
  for (const VertexRange& run : whole_runs_) add_rest(run, others.subspan(find_from(others, run.begin)));
}

/// Adds the vertices of `run` that are not in `others`, of which the first does not begin before the run.
void VertexSet::add_rest(const VertexRange& run, std::span<const LeafSubset> others) {
  VertexId begin = run.begin;
  for (const LeafSubset& other : others) {
    const VertexId first = index_->leaf_begin[other.leaf];
    if (first >= run.end) break;
    const VertexId end = index_->leaf_begin[other.leaf + 1];
    if (begin < first) runs_.push_back({begin, first});
    const LaneMask rest = first_lanes(end - first) & ~other.lanes;
    if (rest != 0) subsets_.push_back({other.leaf, rest});  // mutant: rest-of-cut-leaf-dropped
    begin = end;
  }
  if (begin < run.end) runs_.push_back({begin, run.end});
}

/// The first of `subsets` whose leaf does not begin before `vertex`.
std::size_t VertexSet::find_from(std::span<const LeafSubset> subsets, VertexId vertex) const {
  const auto found = std::partition_point(subsets.begin(), subsets.end(), [&](const LeafSubset& subset) {
    return index_->leaf_begin[subset.leaf] < vertex;
  });
  return static_cast<std::size_t>(found - subsets.begin());
}

std::span<const VertexRange> VertexSet::all_as_runs() {
  for (const LeafSubset& subset : subsets_) {
    const VertexId first = index_->leaf_begin[subset.leaf];
    for (std::uint64_t left = subset.lanes; left != 0;) {
      const auto begin = static_cast<unsigned>(std::countr_zero(left));
      const auto end = begin + static_cast<unsigned>(std::countr_one(left >> begin));
      runs_.push_back({static_cast<VertexId>(first + begin), static_cast<VertexId>(first + end)});
      left = left >> end << end;
    }
  }
  subsets_.clear();
  return runs_;
}

}  // namespace meshhood
