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
  for (const GroupEntry entry : spread_.whole()) {
    const std::size_t size =
        group_.is_core(entry) ? group_.core_vertices(entry) : index_->leaves[group_.leaf(entry)].size;
    const QueryWord word = spread_.whole_word(entry);
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

/// The whole leaves that every query reaches are copied together once, and written by each query in one piece.
void JointSearch::collect_common() {
  if (has_common_) return;
  has_common_ = true;
  common_ids_.clear();
  some_whole_.clear();
  for (const GroupEntry entry : spread_.whole()) {
    if (group_.is_core(entry) || spread_.whole_word(entry) != packet_->queries()) {
      some_whole_.push_back(entry);
    } else {
      append_ids(*index_, vertices_of(group_.leaf(entry)), common_ids_);
    }
  }
}

void JointSearch::write_ids(unsigned query, VertexId* ids) {
  collect_common();
  ids = std::copy(common_ids_.begin(), common_ids_.end(), ids);
  for (const GroupEntry entry : some_whole_) {
    if ((spread_.whole_word(entry) >> query & 1U) == 0) continue;
    if (group_.is_core(entry)) {
      const std::span<const VertexId> core = group_.core_ids(entry);
      ids = std::copy(core.begin(), core.end(), ids);
    } else {
      const VertexRange run = vertices_of(group_.leaf(entry));
      for (std::size_t vertex = run.begin; vertex < run.end; ++vertex) *ids++ = index_->id(vertex);
    }
  }
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_words(spread_.words(), spread_.partial(), query, permutation, ids);
}

/// Calls `f(vertex)` for all vertices of a neighborhood in index order, in the order of its ids.
template <class F>
void JointSearch::for_each_vertex(unsigned query, F&& f) {
  collect_common();
  const auto visit = [&](const VertexRange& run) {
    for (std::size_t vertex = run.begin; vertex < run.end; ++vertex) f(vertex);
  };
  for (const GroupEntry entry : spread_.whole()) {
    if (!group_.is_core(entry) && spread_.whole_word(entry) == packet_->queries()) {
      visit(vertices_of(group_.leaf(entry)));
    }
  }
  for (const GroupEntry entry : some_whole_) {
    if ((spread_.whole_word(entry) >> query & 1U) == 0) continue;
    if (group_.is_core(entry)) {
      for (const LeafRun& run : group_.core_runs(entry)) visit(run.vertices);
    } else {
      visit(vertices_of(group_.leaf(entry)));
    }
  }
  for (const LeafOfWords& leaf : spread_.partial()) {
    for_each_lane(kernels_->lanes_of(spread_.words()[leaf.words].reached, query),
                  [&](unsigned lane) { f(std::size_t{leaf.first} + lane); });
  }
}

void JointSearch::write_distances(unsigned query, double* distances) {
  const Point centre = packet_->centre(query);
  std::visit(
      [&](auto xyz) {
        for_each_vertex(
            query, [&](std::size_t vertex) { *distances++ = std::sqrt(squared_distance(point(xyz, vertex), centre)); });
      },
      index_->positions);
}

const PacketAnswer& JointSearch::answer() {
  cores_.clear();
  whole_.clear();
  partial_.clear();
  for (const GroupEntry entry : spread_.whole()) {
    const QueryWord word = spread_.whole_word(entry);
    if (group_.is_core(entry)) {
      cores_.push_back({group_.core_number(entry), group_.core_runs(entry), group_.core_vertices(entry), word});
    } else {
      const LeafId leaf = group_.leaf(entry);
      whole_.push_back({{leaf, leaf + 1, vertices_of(leaf)}, word});
    }
  }
  for (const LeafOfWords& found : spread_.partial()) {
    const LeafId leaf = group_.leaf(found.words);
    partial_.push_back({leaf, vertices_of(leaf), spread_.words()[found.words].reached});
  }
  answer_.queries = packet_->queries();
  answer_.cores = cores_;
  answer_.whole = whole_;
  answer_.partial = partial_;
  return answer_;
}

VertexRange JointSearch::vertices_of(LeafId leaf) const {
  return {index_->leaf_begin[leaf], index_->leaf_begin[leaf + 1]};
}

}  // namespace meshhood
