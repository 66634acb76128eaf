// SPDX-License-Identifier: MIT
#include "exact/joint/joint_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <variant>

namespace meshhood {

JointSearch::JointSearch(const IndexView& index, Isa isa)
    : index_(&index), kernels_(&joint_kernels(isa)), group_(index, kernels(isa)), spread_(index, *kernels_) {}

void JointSearch::run(LeafId leaf, std::span<const JointQuery> queries) {
  packet_.emplace(*index_, group_, leaf, queries);
  spread_.run(group_, *packet_);
  has_counts_ = false;
  has_common_ = false;
}

const PerLane<std::uint64_t>& JointSearch::counts() {
  if (has_counts_) return counts_;
  has_counts_ = true;
  counts_ = {};
  std::uint64_t common = 0;
  for (const GroupSlot slot : spread_.whole()) {
    const std::size_t size = group_.is_core(slot) ? group_.core_vertices(slot) : index_->leaves[group_.leaf(slot)].size;
    const QueryWord word = spread_.whole_word(slot);
    if (word == packet_->queries()) {
      common += size;
    } else {
      for (QueryWord left = word; left != 0; left &= left - 1)
        counts_[static_cast<std::size_t>(std::countr_zero(left))] += size;
    }
  }
  for (std::size_t i = 0; i < packet_->size(); ++i) counts_[i] += common;
  kernels_->count_words(spread_.words(), spread_.partial(), counts_);
  return counts_;
}

/// The whole slots that every query reaches are copied together once, and written by each query in one piece.
void JointSearch::collect_common() {
  if (has_common_) return;
  has_common_ = true;
  common_ids_.clear();
  some_whole_.clear();
  for (const GroupSlot slot : spread_.whole()) {
    if (group_.is_core(slot) || spread_.whole_word(slot) != packet_->queries()) {
      some_whole_.push_back(slot);
      continue;
    }
    const Leaf& record = index_->leaves[group_.leaf(slot)];
    for (std::size_t i = 0; i < record.size; ++i) common_ids_.push_back(index_->id(record.first + i));
  }
}

void JointSearch::write_ids(unsigned query, VertexId* ids) {
  collect_common();
  ids = std::copy(common_ids_.begin(), common_ids_.end(), ids);
  for (const GroupSlot slot : some_whole_) {
    if ((spread_.whole_word(slot) >> query & 1U) == 0) continue;
    if (group_.is_core(slot)) {
      const std::span<const VertexId> core = group_.core_ids(slot);
      ids = std::copy(core.begin(), core.end(), ids);
    } else {
      const Leaf& record = index_->leaves[group_.leaf(slot)];
      for (std::size_t i = 0; i < record.size; ++i) *ids++ = index_->id(record.first + i);
    }
  }
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_words(spread_.words(), spread_.partial(), query, permutation, ids);
}

/// Calls `f(leaf, lanes)` for all leaves of a neighborhood, in the order of its ids.
template <class F>
void JointSearch::for_each_run(unsigned query, F&& f) {
  collect_common();
  const auto visit = [&](LeafId leaf) { f(leaf, first_lanes(index_->leaves[leaf].size)); };
  for (const GroupSlot slot : spread_.whole()) {
    if (!group_.is_core(slot) && spread_.whole_word(slot) == packet_->queries()) visit(group_.leaf(slot));
  }
  for (const GroupSlot slot : some_whole_) {
    if ((spread_.whole_word(slot) >> query & 1U) == 0) continue;
    if (group_.is_core(slot)) {
      for (const LeafId leaf : group_.core_leaves(slot)) visit(leaf);
    } else {
      visit(group_.leaf(slot));
    }
  }
  for (const LeafOfWords& leaf : spread_.partial()) {
    f(group_.leaf(leaf.words), kernels_->lanes_of(spread_.words()[leaf.words].reached, query));
  }
}

void JointSearch::write_distances(unsigned query, double* distances) {
  const Point centre = packet_->centre(query);
  std::visit(
      [&](auto xyz) {
        for_each_run(query, [&](LeafId leaf, LaneMask lanes) {
          const std::size_t first = index_->leaves[leaf].first;
          for (; lanes != 0; lanes &= lanes - 1) {
            const std::size_t vertex = first + static_cast<std::size_t>(std::countr_zero(lanes));
            *distances++ = std::sqrt(squared_distance(point(xyz, vertex), centre));
          }
        });
      },
      index_->positions);
}

}  // namespace meshhood
