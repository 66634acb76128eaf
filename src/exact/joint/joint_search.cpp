// SPDX-License-Identifier: MIT
#include "exact/joint/joint_search.h"

#include <bit>
#include <cassert>

namespace meshhood {

JointSearch::JointSearch(const IndexView& index, Isa isa)
    : index_(&index), kernels_(&joint_kernels(isa)), group_(index, isa), spread_(index, isa) {}

void JointSearch::run(LeafId leaf, std::span<const JointQuery> queries) {
  packet_.emplace(*index_, group_, leaf, queries);
  spread_.run(group_, *packet_);
  has_counts_ = false;
}

const PerLane<std::uint64_t>& JointSearch::counts() {
  assert(packet_);  // of the last `run`
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
  for_each_lane(packet_->queries(), [&](unsigned query) { counts_[query] += common; });
  kernels_->count_words(spread_.words(), spread_.partial(), counts_);
  return counts_;
}

const PacketAnswer& JointSearch::answer() {
  assert(packet_);
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
