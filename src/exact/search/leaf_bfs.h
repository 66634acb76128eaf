// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "exact/layout.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/vertex_set.h"

namespace meshhood {

/// Breadth-first search over leaves. Visits the leaves of the answer and their neighbors, so its cost does not depend
/// on what else lies in the ball.
class LeafBfs {
 public:
  explicit LeafBfs(const IndexView& index) : index_(&index) {}

  /// Adds the neighborhood of the query to `answer`, which is empty.
  ///
  /// is_small  whether the ball reaches hardly beyond the neighbors of the first leaf. Then only those are prefetched.
  void run(const Query& query, bool is_small, LeafTraversal& traversal, VertexSet& answer);

  /// The number of visits of leaves that the last call has taken.
  [[nodiscard]] std::size_t visits() const { return visits_; }

 private:
  /// First in, first out. Prefetches the neighbors and the first cross edges of the leaves that come next.
  class Queue {
   public:
    void start(const LeafTraversal& traversal, std::size_t most_prefetched);
    void push(LeafId leaf) { leaves_.push_back(leaf); }
    [[nodiscard]] LeafId pop();
    [[nodiscard]] bool empty() const { return head_ == leaves_.size(); }
    template <class F>
    void clear(F&& f) {
      for (; !empty(); ++head_) f(leaves_[head_]);
    }

   private:
    const LeafTraversal* traversal_ = nullptr;
    std::vector<LeafId> leaves_;
    std::size_t head_ = 0;
    std::size_t prefetched_ = 0;
    std::size_t most_prefetched_ = 0;
  };

  const IndexView* index_;
  Queue queue_;
  std::size_t visits_ = 0;
};

}  // namespace meshhood
