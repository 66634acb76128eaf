// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"

namespace meshhood {

/// Some of the vertices of a leaf.
struct LeafSubset {
  LeafId leaf;
  LaneMask lanes;
};

/// std::popcount, which is a call of a library function when compiling for the oldest processors.
[[nodiscard]] inline std::size_t count_of(LaneMask lanes) {
  lanes -= lanes >> 1 & 0x55555555U;
  lanes = (lanes & 0x33333333U) + (lanes >> 2 & 0x33333333U);
  return ((lanes + (lanes >> 4)) & 0x0F0F0F0FU) * 0x01010101U >> 24;
}

/// The vertices of the node at a place of a group.
[[nodiscard]] inline VertexRange run_of(const GroupRecord& group, unsigned place) {
  return {static_cast<VertexId>(group.begin[place]), static_cast<VertexId>(group.begin[place + 1])};
}

/// A set of vertices: runs of whole leaves in index order, and subsets of leaves. No vertex is added twice.
class VertexSet {
 public:
  explicit VertexSet(const IndexView& index) : index_(&index) {}

  void clear() {
    runs_.clear();
    subsets_.clear();
  }

  /// Adds a run of whole leaves. One that follows the last becomes a part of it.
  void add(const VertexRange& run) {
    if (!runs_.empty() && runs_.back().end == run.begin) {
      runs_.back().end = run.end;
    } else {
      runs_.push_back(run);
    }
  }
  void add(const LeafSubset& subset) { subsets_.push_back(subset); }

  /// Removes the vertices of `others`, which ascend by leaf and name each leaf once. O(size of this * log size of
  /// others).
  void subtract(std::span<const LeafSubset> others);

  [[nodiscard]] bool is_one_vertex() const {
    return runs_.empty() && subsets_.size() == 1 && (subsets_[0].lanes & (subsets_[0].lanes - 1)) == 0;
  }

  [[nodiscard]] std::size_t count() const {
    std::size_t result = 0;
    for (const VertexRange& run : runs_) result += std::size_t{run.end} - run.begin;
    for (const LeafSubset& subset : subsets_) result += count_of(subset.lanes);
    return result;
  }
  [[nodiscard]] std::span<const VertexRange> runs() const { return runs_; }
  [[nodiscard]] std::span<const LeafSubset> subsets() const { return subsets_; }

  /// Calls `f(vertex)` for every vertex, by its number in index order: first those of the runs, then those of the
  /// subsets.
  template <class F>
  void for_each(F&& f) const {
    for (const VertexRange& run : runs_) {
      for (std::size_t vertex = run.begin; vertex < run.end; ++vertex) f(vertex);
    }
    for (const LeafSubset& subset : subsets_) {
      const std::size_t first = index_->leaf_begin[subset.leaf];
      for_each_lane(subset.lanes, [&](unsigned lane) { f(first + lane); });
    }
  }

  /// Turns the subsets into runs. Nothing can be subtracted from the set afterwards.
  [[nodiscard]] std::span<const VertexRange> all_as_runs();

 private:
  void add_rest(const VertexRange& run, std::span<const LeafSubset> others);
  [[nodiscard]] std::size_t find_from(std::span<const LeafSubset> subsets, VertexId vertex) const;

  const IndexView* index_;
  std::vector<VertexRange> runs_;
  std::vector<LeafSubset> subsets_;
  std::vector<VertexRange> whole_runs_;  // scratch of `subtract`
};

}  // namespace meshhood
