// SPDX-License-Identifier: MIT
#include "exact/query/length_search.h"

#include <vector>

#include "exact/query/path_search.h"
#include "exact/vertex_set.h"

namespace meshhood::inline v0_1 {
namespace {

class PathLengthSearch final : public LengthSearch {
 public:
  PathLengthSearch(const IndexView& index, KeptGraph& graph) : LengthSearch(index), paths_(index, graph) {}

  void run(std::span<const Path> starts, double radius, const IsEnough& is_enough) override {
    paths_.run(starts, radius,
               [&](std::span<const Path> found) { return is_enough && is_enough(without_ignored(found)); });
  }

  std::span<const Path> found() override { return without_ignored(paths_.found()); }
  std::span<const Path> in_order() override { return without_ignored(paths_.found_in_order()); }

 private:
  std::span<const Path> without_ignored(std::span<const Path> paths) {
    if (index_->ignored.empty()) return paths;
    some_.clear();
    for (const Path& path : paths) {
      if (!index_->is_ignored_at(path.end)) some_.push_back(path);
    }
    return some_;
  }

  PathSearch paths_;
  std::vector<Path> some_;
};

}  // namespace

void LengthSearch::collect(std::vector<LeafSubset>& subsets) {
  for (const Path& path : found()) {
    const std::uint32_t slot = index_->slot_at(path.end);
    subsets.push_back({leaf_of(slot), LaneMask{1} << lane_of(slot)});
  }
}

std::unique_ptr<LengthSearch> make_length_search(const IndexView& index, KeptGraph& graph, Metric metric,
                                                 const Kernels& kernels) {
  if (metric == Metric::Path) return std::make_unique<PathLengthSearch>(index, graph);
  return make_ring_search(index, graph, kernels);
}

}  // namespace meshhood::inline v0_1
