// SPDX-License-Identifier: MIT
#include "aggregate/path_reducer.h"

#include <limits>

#include "aggregate/compensated.h"

namespace meshhood {

void PathSetReducer::reduce(PathPacket& packet, std::span<const double> radii) {
  PacketAnswer answer;
  answer.queries = first_lanes(static_cast<unsigned>(radii.size()));
  answer.pieces = packet.pieces(radii);
  nodes_.reduce(answer, *reducer_);
}

PathKernelReducer::PathKernelReducer(const SumColumns& columns, bool squared)
    : kernels_(&aggregate_kernels(best_isa())), columns_(&columns), squared_(squared), sums_(columns.size()) {}

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
      kernels_->set_path_weights(leaf.lengths[lane], divisors, squared_, weights_[lane]);
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const auto values = std::span(columns_->column(i)).subspan(leaf.vertices.begin, leaf.vertices.size());
      kernels_->add_weighted(values, leaf.queries.data(), weights_, sums_[i]);
    }
  });
}

void PathKernelReducer::write(std::size_t query, std::span<double> channels) {
  totals_.clear();
  for (const RowSums& sums : sums_) totals_.push_back(CompensatedSum{sums.high[query], sums.low[query]}.value());
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i] = columns_->result(i, totals_);
}

}  // namespace meshhood
