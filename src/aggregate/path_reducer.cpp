// SPDX-License-Identifier: MIT
#include "aggregate/path_reducer.h"

#include "aggregate/compensated.h"
#include "aggregate/kernel_weight.h"

namespace meshhood {

void PathSetReducer::reduce(std::span<const Path> paths, double /*radius*/, std::span<double> channels) {
  lanes_.clear();
  for (const Path& path : paths) {
    const std::uint32_t slot = index_->slot[index_->id(path.end)];
    lanes_.push_back({leaf_of(slot), LaneMask{1} << lane_of(slot)});
  }
  set_.assign(lanes_);
  nodes_.reduce(packet_.describe(*index_, set_), *reducer_);
  reducer_->write(0, channels);
}

void PathKernelReducer::reduce(std::span<const Path> paths, double radius, std::span<double> channels) {
  weights_.clear();
  for (const Path& path : paths) weights_.push_back(kernel_weight(kernel_, path.length, radius));
  totals_.clear();
  for (std::size_t i = 0; i < columns_->size(); ++i) {
    CompensatedSum sum;
    for (std::size_t k = 0; k < paths.size(); ++k) sum.add(weights_[k] * columns_->column(i)[paths[k].end]);
    totals_.push_back(sum.value());
  }
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i] = columns_->result(i, totals_);
}

}  // namespace meshhood
