// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/aggregate.h"

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/signal_block.h"
#include "aggregate/sums.h"

/// The kinds of reductions, each written in a file of its own. They borrow index and tree.
namespace meshhood {

/// The minimum or the maximum. NaN marks a missing value, or propagates to the result. The block is not scaled, and its
/// values were not omitted.
[[nodiscard]] Reduction minimum_reduction(const NodeTree& tree, SignalBlock block, bool maximum, MissingValues missing);

/// A quantile, of the same blocks.
[[nodiscard]] Reduction quantile_reduction(const NodeTree& tree, SignalBlock block, double quantile,
                                           MissingValues missing);

/// How the variance follows from a sum of squares.
struct VarianceOptions {
  bool root;      ///< the standard deviation
  unsigned ddof;  ///< see `AggregateQuery::ddof`
};
[[nodiscard]] Reduction variance_reduction(const NodeTree& tree, SignalBlock block, const VarianceOptions& options);

/// Sum, mean and count with the weight of a vertex alone.
[[nodiscard]] Reduction sum_reduction(const NodeTree& tree, SumColumns columns);

/// Sum and mean with weights that fall with the distance. `squared`: the biweight, else Epanechnikov.
[[nodiscard]] Reduction kernel_sum_reduction(const IndexView& index, const NodeTree& tree, SumColumns columns,
                                             bool squared);

/// Sum and mean with a weight for each vertex of a row, where no moments of few terms give the sum over a node: weights
/// that fall with the distance as a Gaussian, or if packets have lengths, by any kernel but the box with these.
[[nodiscard]] Reduction weighted_reduction(const IndexView& index, SumColumns columns, SmoothingKernel kernel,
                                           bool has_lengths);

}  // namespace meshhood
