// SPDX-License-Identifier: MIT
#include "aggregate/path_reducer.h"

#include <limits>

namespace meshhood {

void PathSetReducer::reduce(PathPacket& packet, std::span<const double> radii) {
  PacketAnswer answer;
  answer.queries = first_lanes(static_cast<unsigned>(radii.size()));
  answer.pieces = packet.pieces(radii);
  nodes_.reduce(answer, *reducer_);
}

PathKernelReducer::PathKernelReducer(const SumColumns& columns, SmoothingKernel kernel)
    : kernels_(&aggregate_kernels(best_isa())), columns_(&columns), kernel_(kernel), sums_(columns.size()) {}

void PathKernelReducer::reduce(PathPacket& packet, std::span<const double> radii) {
  for (RowSums& sums : sums_) sums = {};
  PathLengths divisors{};
  divisors.fill(1);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    // Within a radius of 0 all lengths are 0, and all weights 1.
    divisors[i] = radii[i] > 0 ? radii[i] : std::numeric_limits<double>::infinity();
  }
  packet.for_each_leaf(radii, [&](const PathLeaf& leaf) {
    for (std::size_t lane = 0; lane < leaf.vertices.size(); ++lane) {
      if (leaf.queries[lane] == 0) continue;
      kernels_->set_path_weights(leaf.lengths[lane], divisors, kernel_, weights_[lane]);
    }
    columns_->add_weighted(*kernels_, leaf.vertices, leaf.queries.data(), weights_, sums_);
  });
}

void PathKernelReducer::write(std::size_t query, std::span<double> channels) {
  columns_->write(sums_, query, channels);
}

}  // namespace meshhood
