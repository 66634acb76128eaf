// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Some of the vertices of a leaf.
struct LeafSubset {
  LeafId leaf;
  LaneMask lanes;
};

/// Returns the vertices of the node at a place of a group.
[[nodiscard]] inline VertexRange run_of(const GroupRecord& group, unsigned place) {
  return {static_cast<VertexId>(group.begin[place]), static_cast<VertexId>(group.begin[place + 1])};
}

/// Returns the vertices of a node of the tree.
[[nodiscard]] inline VertexRange run_of(const IndexView& index, NodeId node) {
  return run_of(index.records[node / kFanOut], node % kFanOut);
}

/// A set of vertices in index order, in one list: runs, and subsets of at most 32 consecutive vertices. Nearly always
/// these are whole leaves and subsets of leaves; those of `VertexBfs` lie anywhere.
class VertexSet {
 public:
  /// A run, or those of at most 32 vertices that `lanes` names.
  struct Part {
    VertexId begin;
    VertexId end;
    LaneMask lanes;  // 0 for a run

    [[nodiscard]] bool is_run() const { return lanes == 0; }
  };

  explicit VertexSet(const IndexView& index) : index_(&index) {}

  void clear() { size_ = 0; }

  /// Adds a run of whole leaves behind all that were added before. A run that follows on a run becomes a part of it.
  void add(const VertexRange& run) {
    make_room(1);
    add_if(true, run, 0);
  }

  /// Adds vertices of a leaf: none of them, some or all.
  void add_lanes(const LeafSubset& subset) { add_lanes(vertices_of(subset.leaf), subset.lanes); }

  /// Adds vertices of any range of at most 32 vertices.
  void add_lanes(const VertexRange& all, LaneMask lanes) {
    assert(all.end <= index_->vertex_count());
    make_room(1);
    add_if(lanes != 0, all, lanes == first_lanes(static_cast<unsigned>(all.size())) ? 0 : lanes);
  }

  /// Prepares for that many calls of `add_if`.
  void make_room(std::size_t parts) {
    if (parts_.size() < size_ + parts + 1) parts_.resize(2 * (size_ + parts + 1));
  }

  /// Adds the vertices of a run, or the lanes of a leaf, if `condition` holds, without branches.
  void add_if(bool condition, const VertexRange& vertices, LaneMask lanes) {
    Part* next = parts_.data() + size_;
    const bool follows =
        condition && size_ != 0 && (next - 1)->is_run() && lanes == 0 && (next - 1)->end == vertices.begin;
    Part& part = *(next - static_cast<std::ptrdiff_t>(follows));
    part = {follows ? part.begin : vertices.begin, vertices.end, lanes};
    size_ += static_cast<std::size_t>(condition && !follows);
  }

  /// Cuts the set at the ends of leaves, and joins what is of one leaf, so that every run has whole leaves and every
  /// subset is one of a leaf. Only sets of `VertexBfs` need it.
  void align_to_leaves();

  /// Adds the vertices of each leaf to `found`. Runs have whole leaves, and subsets are of a leaf.
  void collect(std::vector<LeafSubset>& found) const;

  /// Takes vertices, given by leaf, out of such a set.
  void leave_out(std::span<const LaneMask> by_leaf);

  /// Refills the set with the union of `subsets`, in any order, each vertex once.
  void assign(std::span<const LeafSubset> subsets);

  /// Refills the set with the vertices of `all` that `part`, a subset of it, does not have.
  void assign_difference(const VertexSet& all, const VertexSet& part);

  [[nodiscard]] std::size_t count() const {
    std::size_t result = 0;
    for (const Part& part : parts()) {
      result += part.is_run() ? std::size_t{part.end} - part.begin : count_of(part.lanes);
    }
    return result;
  }
  [[nodiscard]] std::span<const Part> parts() const { return {parts_.data(), size_}; }

  /// Calls `f(vertex)` for every vertex, by its number in index order, ascending.
  template <class F>
  void for_each(F&& f) const {
    for (const Part& part : parts()) {
      if (part.is_run()) {
        for (std::size_t vertex = part.begin; vertex < part.end; ++vertex) f(vertex);
      } else {
        for_each_lane(part.lanes, [&](unsigned lane) { f(std::size_t{part.begin} + lane); });
      }
    }
  }

  /// Returns the set as ranges, ascending, as few as possible. They are valid until the set changes.
  [[nodiscard]] std::span<const VertexRange> ranges();

 private:
  void add(const Part& part) {
    make_room(1);
    parts_[size_++] = part;
  }
  [[nodiscard]] VertexRange vertices_of(LeafId leaf) const {
    return {index_->leaf_begin[leaf], index_->leaf_begin[leaf + 1]};
  }
  const IndexView* index_;
  std::vector<Part> parts_;
  std::size_t size_ = 0;
  std::vector<LeafSubset> sorted_;  // scratch of `assign` and `leave_out`
  std::vector<Part> unaligned_;     // scratch of `align_to_leaves`
  std::vector<VertexRange> ranges_;
};

/// Writes the caller's ids of `set`, in index order. `out` has room for `set.count()` ids, and for `kLeafCapacity`
/// more, whose content is unspecified afterwards.
void write_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, VertexId* out);

/// Refills `out` with them.
void replace_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out);

/// Appends them to `out`.
void append_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out);

/// Writes the distances of the same vertices from `center`, in the same order; `set.count()` of them.
void write_distances(const VertexSet& set, const IndexView& index, const Point& center, double* out);

}  // namespace meshhood::inline v0_1
