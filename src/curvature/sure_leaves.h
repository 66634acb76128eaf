// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/epoch_array.h"
#include "base/vector.h"
#include "exact/layout.h"
#include "simd/ball.h"
#include "simd/leaf.h"

namespace meshhood::inline v0_1 {

/// The *sure leaves* of a leaf for a radius: leaves that are whole in the neighborhoods of all its vertices, as spheres
/// and links tell. They depend on index, leaf and radius alone, and those of a smaller radius are a prefix of those of
/// a larger one. So a sum over them is made once for queries of any radii.
///
/// Let the leaf have the sphere (c, s), and another leaf the sphere (d, t). Each vertex of the one is at most
/// s + |c - d| + t, the *reach* of the other, from each vertex of the latter. A sure leaf is connected, has a reach of
/// at most the radius, and is the leaf itself or linked with a sure leaf. So all its vertices are in the ball, and
/// connected with the query vertex by leaves in the ball. Leaves with walls are not connected; one with ignored
/// vertices is not whole, and is left out, too.
class SureLeaves {
 public:
  /// Borrows the index.
  explicit SureLeaves(const IndexView& index) : index_(&index), queries_(index.leaf_count()) {}

  /// Begins with a leaf, for growing radii.
  void begin(LeafId leaf);

  /// The next sure leaf for this radius; none if there are no more. The order is that of Prim's algorithm: of
  /// the leaves that are linked with those before, the one of least reach. It does not depend on the radii.
  [[nodiscard]] std::optional<LeafId> next(const TreeBounds& radius);

  /// The queries whose sum has a leaf already: set by the caller for one that `next` returned, at first none.
  void set_queries(LeafId leaf, QueryWord queries) { queries_[leaf] = queries; }
  [[nodiscard]] QueryWord queries(LeafId leaf) const { return queries_.is_known(leaf) ? queries_[leaf] : 0; }

 private:
  struct Entry {
    double reach;  // in the frame
    LeafId leaf;
  };

  /// Whether `a` comes after `b`.
  static bool is_later(const Entry& a, const Entry& b) {
    return a.reach != b.reach ? a.reach > b.reach : a.leaf > b.leaf;
  }

  void meet(LeafId leaf);

  const IndexView* index_;
  FrameSphere center_{};
  std::vector<Entry> frontier_;    // a heap
  EpochArray<QueryWord> queries_;  // known of the leaves that were met
};

inline void SureLeaves::begin(LeafId leaf) {
  queries_.forget();
  frontier_.clear();
  center_ = index_->leaves[leaf].bounds;
  meet(leaf);
}

inline std::optional<LeafId> SureLeaves::next(const TreeBounds& radius) {
  if (frontier_.empty() || frontier_.front().reach > static_cast<double>(radius.inner)) return std::nullopt;
  std::pop_heap(frontier_.begin(), frontier_.end(), is_later);
  const LeafId leaf = frontier_.back().leaf;
  frontier_.pop_back();
  for (const Link& link : index_->links_of(leaf)) meet(link.leaf);
  return leaf;
}

/// Takes a leaf into the frontier, once.
inline void SureLeaves::meet(LeafId leaf) {
  if (queries_.is_known(leaf)) return;
  queries_.set(leaf, 0);
  const Leaf& other = index_->leaves[leaf];
  if (!other.connected || index_->ignored_lanes(leaf) != 0) return;
  const double distance = length(center_of(other.bounds) - center_of(center_));
  frontier_.push_back({(double{center_.radius} + distance) + double{other.bounds.radius}, leaf});
  std::push_heap(frontier_.begin(), frontier_.end(), is_later);
}

}  // namespace meshhood::inline v0_1
