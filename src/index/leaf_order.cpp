// SPDX-License-Identifier: MIT
#include "index/leaf_order.h"

#include <algorithm>

#include "index/layout.h"

namespace meshhood {
namespace {

class Order {
 public:
  Order(std::span<Site> all, const Rows& graph) : all_(all), graph_(graph), set_(graph.begin.size() - 1) {}

  /// Orders `all[begin] .. all[end - 1]`.
  void run(std::size_t begin, std::size_t end) {
    while (begin / kFanOut != (end - 1) / kFanOut) {
      const std::size_t first = gather_component(begin, end);
      const std::size_t middle = first < end ? first : cut_near_the_middle(begin, end);
      run(begin, middle);
      begin = middle;
    }
  }

 private:
  /// Moves the component of the first leaf among those given to the front, and returns where it ends.
  std::size_t gather_component(std::size_t begin, std::size_t end) {
    const std::uint32_t here = ++sets_;
    const std::uint32_t found = ++sets_;
    for (std::size_t i = begin; i < end; ++i) set_[all_[i].id] = here;
    queue_.assign(1, all_[begin].id);
    set_[queue_[0]] = found;
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      for (const std::uint32_t next : graph_[queue_[head]]) {
        if (set_[next] != here) continue;
        set_[next] = found;
        queue_.push_back(next);
      }
    }
    if (queue_.size() < end - begin) {
      std::stable_partition(at(begin), at(end), [&](const Site& leaf) { return set_[leaf.id] == found; });
    }
    return begin + queue_.size();
  }

  /// A multiple of the largest power of eight that has one between `begin` and `end`: that nearest to the middle.
  std::size_t cut_near_the_middle(std::size_t begin, std::size_t end) {
    std::size_t unit = kFanOut;
    while ((begin / (unit * kFanOut) + 1) * (unit * kFanOut) < end) unit *= kFanOut;
    const std::size_t first = (begin / unit + 1) * unit;
    const std::size_t last = (end - 1) / unit * unit;
    const std::size_t middle = std::clamp((begin + end) / 2 / unit * unit, first, last);
    cut_across(all_.subspan(begin, end - begin), middle - begin);
    return middle;
  }

  [[nodiscard]] std::span<Site>::iterator at(std::size_t i) const {
    return all_.begin() + static_cast<std::ptrdiff_t>(i);
  }

  std::span<Site> all_;
  const Rows& graph_;
  std::vector<std::uint32_t> set_;  // by leaf: that to which it was last found to belong
  std::uint32_t sets_ = 0;
  std::vector<std::uint32_t> queue_;
};

}  // namespace

void order_leaves(std::span<Site> leaves, const Rows& graph) {
  if (!leaves.empty()) Order(leaves, graph).run(0, leaves.size());
}

}  // namespace meshhood
