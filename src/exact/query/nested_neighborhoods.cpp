// SPDX-License-Identifier: MIT
#include "exact/query/nested_neighborhoods.h"

#include "exact/search/output.h"

namespace meshhood {

NestedNeighborhoods::NestedNeighborhoods(const std::shared_ptr<const IndexView>& index, Isa isa)
    : index_(index.get()), search_(index, isa), found_(index->leaf_count()), ring_(*index) {
  leaf_before_.reserve(index->vertex_count() / kLeafCapacity + 1);
  LeafId leaf = 0;
  for (std::size_t first = 0; first < index->vertex_count(); first += kLeafCapacity) {
    while (index->leaf_begin[leaf + 1] < first) ++leaf;
    leaf_before_.push_back(leaf);
  }
}

/// The leaf that begins with a vertex, which is named by its place in index order.
LeafId NestedNeighborhoods::leaf_at(VertexId first) const {
  LeafId leaf = leaf_before_[first / kLeafCapacity];
  while (index_->leaf_begin[leaf + 1] <= first) ++leaf;
  return leaf;
}

void NestedNeighborhoods::run(VertexId v, std::span<const double> radii, std::vector<VertexId>& out,
                              std::vector<std::size_t>& sizes) {
  forget();
  sizes.clear();
  std::size_t size = 0;
  for (const double radius : radii) {
    search_.search(v, radius);  // never into `ids`: the graph is copied only for searches that are recorded
    find_ring();
    const std::size_t end = size + ring_.count();
    ids_.resize(end + kLeafCapacity);
    write_ids(ring_, *index_, *search_.kernels, &ids_[size]);
    size = end;
    sizes.push_back(size);
  }
  ids_.resize(size);
  out.swap(ids_);
}

/// The vertices of the answer that no ring has yet.
void NestedNeighborhoods::find_ring() {
  ring_.clear();
  for (const VertexRange& run : search_.answer.runs()) {
    for (LeafId leaf = leaf_at(run.begin); index_->leaf_begin[leaf] < run.end; ++leaf) {
      if (found_[leaf] != kAll) add_whole(leaf);
    }
  }
  for (const LeafSubset& subset : search_.answer.subsets()) add(subset);
}

void NestedNeighborhoods::add_whole(LeafId leaf) {
  const VertexRange vertices{index_->leaf_begin[leaf], index_->leaf_begin[leaf + 1]};
  if (found_[leaf] == 0) {
    leaves_.push_back(leaf);
    ring_.add(vertices);
  } else {
    ring_.add(LeafSubset{leaf, first_lanes(vertices.end - vertices.begin) & ~found_[leaf]});
  }
  found_[leaf] = kAll;
}

void NestedNeighborhoods::add(const LeafSubset& subset) {
  LaneMask& found = found_[subset.leaf];
  const LaneMask added = subset.lanes & ~found;  // mutant: nested-rings-overlap
  if (added == 0) return;
  if (found == 0) leaves_.push_back(subset.leaf);
  found |= added;
  ring_.add(LeafSubset{subset.leaf, added});
}

/// At the beginning, so that a run that throws leaves nothing behind.
void NestedNeighborhoods::forget() {
  for (const LeafId leaf : leaves_) found_[leaf] = 0;  // mutant: rings-of-last-run-kept
  leaves_.clear();
}

}  // namespace meshhood
