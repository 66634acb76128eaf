// SPDX-License-Identifier: MIT
#include "curvature/sure_leaves.h"

#include <algorithm>

#include "base/vector.h"

namespace meshhood {

void SureLeaves::begin(LeafId leaf) {
  queries_.forget();
  frontier_.clear();
  center_ = index_->leaves[leaf].bounds;
  meet(leaf);
}

std::optional<LeafId> SureLeaves::next(const TreeBounds& radius) {
  if (frontier_.empty() || frontier_.front().reach > static_cast<double>(radius.inner)) return std::nullopt;
  std::pop_heap(frontier_.begin(), frontier_.end(), is_later);
  const LeafId leaf = frontier_.back().leaf;
  frontier_.pop_back();
  for (const Link& link : index_->links_of(leaf)) meet(link.leaf);
  return leaf;
}

/// Takes a leaf into the frontier, once.
void SureLeaves::meet(LeafId leaf) {
  if (queries_.is_known(leaf)) return;
  queries_.set(leaf, 0);
  const Leaf& other = index_->leaves[leaf];
  if (!other.connected || index_->ignored_lanes(leaf) != 0) return;
  const double distance = length(center_of(other.bounds) - center_of(center_));
  frontier_.push_back({(double{center_.radius} + distance) + double{other.bounds.radius}, leaf});
  std::push_heap(frontier_.begin(), frontier_.end(), is_later);
}

}  // namespace meshhood
