// SPDX-License-Identifier: MIT
#include "exact/joint/joint_search.h"

#include <algorithm>
#include <cassert>

namespace meshhood::inline v0_1 {

JointSearch::JointSearch(const IndexView& index, Isa isa)
    : index_(&index), kernels_(&joint_kernels(isa)), group_(index, isa), spread_(index, isa) {}

void JointSearch::run(LeafId leaf, std::span<const JointQuery> queries) {
  packet_.emplace(*index_, group_, leaf, queries);
  spread_.run(group_, *packet_);
}

const PerLane<std::uint64_t>& JointSearch::counts() {
  assert(packet_);  // of the last `run`
  counts_ = {};
  std::uint64_t common = 0;
  for (const GroupEntry entry : spread_.whole()) {
    const std::size_t size =
        group_.is_core(entry) ? group_.core_vertices(entry) : index_->leaves[group_.leaf(entry)].size;
    const QueryWord word = spread_.whole_word(entry);
    if (word == packet_->queries()) {
      common += size;
    } else {
      for_each_query(word, [&](std::size_t query) { counts_[query] += size; });
    }
  }
  for_each_query(packet_->queries(), [&](std::size_t query) { counts_[query] += common; });
  kernels_->count_words(spread_.words(), spread_.partial(), counts_);
  return counts_;
}

std::span<const Piece> JointSearch::pieces() {
  assert(packet_);
  pieces_.clear();
  for (const GroupEntry entry : spread_.whole()) {
    const QueryWord word = spread_.whole_word(entry);
    if (group_.is_core(entry)) {
      for (const LeafRun& run : group_.core_runs(entry)) pieces_.push_back({run, word, nullptr});
    } else {
      const LeafId leaf = group_.leaf(entry);
      pieces_.push_back({{leaf, leaf + 1}, word, nullptr});
    }
  }
  for (const LeafOfWords& found : spread_.partial()) {
    const LeafId leaf = group_.leaf(found.words);
    pieces_.push_back({{leaf, leaf + 1}, 0, spread_.words()[found.words].reached.data()});
  }
  std::ranges::sort(pieces_, {}, [](const Piece& piece) { return piece.leaves.begin; });
  join_runs();
  return pieces_;
}

void JointSearch::join_runs() {
  std::size_t kept = 0;
  for (const Piece& piece : pieces_) {
    Piece* const last = kept == 0 ? nullptr : &pieces_[kept - 1];
    assert(last == nullptr || last->leaves.end <= piece.leaves.begin);  // an answer names each vertex once
    if (last != nullptr && last->is_run() && piece.is_run() && last->queries == piece.queries &&
        last->leaves.end == piece.leaves.begin) {
      last->leaves.end = piece.leaves.end;
    } else {
      pieces_[kept++] = piece;
    }
  }
  pieces_.resize(kept);
}

}  // namespace meshhood::inline v0_1
