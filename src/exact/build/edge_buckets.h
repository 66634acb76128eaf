// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace meshhood::inline v0_1 {

/// An edge as two slots.
struct SlotEdge {
  std::uint32_t from;
  std::uint32_t to;
};

/// Edges in buckets, to which several threads add at the same time. Their order depends on the threads.
class EdgeBuckets {
 public:
  EdgeBuckets(unsigned threads, std::size_t buckets) : lists_(threads) {
    for (std::vector<List>& of_thread : lists_) of_thread.resize(buckets);
  }

  /// Called by `thread` alone.
  void add(unsigned thread, std::size_t bucket, const SlotEdge& edge) {
    List& list = lists_[thread][bucket];
    if (list.next == list.end) list.start_block();
    *list.next++ = edge;
  }

  /// Calls `f(edge)` for the edges of a bucket, and frees them.
  template <class F>
  void take(std::size_t bucket, F&& f) {
    for (std::vector<List>& of_thread : lists_) {
      List& list = of_thread[bucket];
      for (const Block& block : list.blocks) {
        const SlotEdge* const end = &block == &list.blocks.back() ? list.next : block.get() + kBlockSize;
        for (const SlotEdge* edge = block.get(); edge != end; ++edge) f(*edge);
      }
      list = {};
    }
  }

 private:
  static constexpr std::size_t kBlockSize = 512;
  using Block = std::unique_ptr<SlotEdge[]>;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it

  struct List {
    SlotEdge* next = nullptr;  // in the last block, which ends at `end`
    SlotEdge* end = nullptr;
    std::vector<Block> blocks;

    void start_block() {
      blocks.push_back(std::make_unique_for_overwrite<SlotEdge[]>(kBlockSize));  // NOLINT(modernize-avoid-c-arrays)
      next = blocks.back().get();
      end = next + kBlockSize;
    }
  };

  std::vector<std::vector<List>> lists_;  // by thread, then by bucket
};

}  // namespace meshhood::inline v0_1
