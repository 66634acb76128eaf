// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "meshhood/aggregate.h"

#include "aggregate/node_tree.h"
#include "aggregate/signal_block.h"
#include "aggregate/sums.h"
#include "exact/joint/packet_answer.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Reduces the neighborhoods of a packet, on one thread.
class PacketReducer {
 public:
  PacketReducer() = default;
  PacketReducer(const PacketReducer&) = delete;
  PacketReducer& operator=(const PacketReducer&) = delete;
  virtual ~PacketReducer() = default;

  /// Begins with the rows of another packet.
  virtual void begin(const PacketAnswer& packet) = 0;

  /// Returns whether it takes whole nodes. If not, all vertices are passed to `add_leaf`, in index order.
  [[nodiscard]] virtual bool takes_nodes() const { return true; }

  /// Adds all vertices of each of up to eight nodes, which are neighbors, to the rows of its word.
  virtual void add_nodes(const NodeTree::Children& /*nodes*/, const QueryWord* /*queries*/) {}

  /// Adds each vertex of a leaf, of which rows may have all, to the rows of its word.
  virtual void add_leaf(const VertexRange& vertices, const QueryWord* queries) = 0;

  /// Writes the result of a row, a number for each channel, or for each of its reductions. Everything has been added
  /// before.
  virtual void write(std::size_t row, std::span<double> channels) = 0;
};

/// Makes the reducer of a thread. Any thread may call it.
using ReducerFactory = std::function<std::unique_ptr<PacketReducer>()>;

/// Makes reducers of one kind, which share tables.
template <class Reducer, class Tables>
[[nodiscard]] ReducerFactory factory_of(Tables tables) {
  return [shared = std::make_shared<const Tables>(std::move(tables))] { return std::make_unique<Reducer>(*shared); };
}

// Each of these kinds of reducers is written in a file of its own. They borrow index and tree.

/// Makes reducers for the minimum or the maximum. NaN marks a missing value, or propagates to the result. The block
/// must not be scaled, and must have its missing values.
[[nodiscard]] ReducerFactory minimum_reducers(const NodeTree& tree, SignalBlock block, bool maximum,
                                              MissingValues missing);

/// Makes reducers for a quantile, of such blocks.
[[nodiscard]] ReducerFactory quantile_reducers(const NodeTree& tree, SignalBlock block, double quantile,
                                               MissingValues missing);

/// The way in which the variance follows from a sum of squares.
struct VarianceOptions {
  bool root;      ///< the standard deviation
  unsigned ddof;  ///< see `AggregateQuery::ddof`
};
[[nodiscard]] ReducerFactory variance_reducers(const NodeTree& tree, SignalBlock block, const VarianceOptions& options);

/// Makes reducers for sum, mean and count with the weight of a vertex alone.
[[nodiscard]] ReducerFactory sum_reducers(const NodeTree& tree, SumColumns columns);

/// Makes reducers for sum and mean with weights that fall with distance: biweight if `squared`, else Epanechnikov.
[[nodiscard]] ReducerFactory kernel_sum_reducers(const IndexView& index, const NodeTree& tree, SumColumns columns,
                                                 bool squared);

/// Makes reducers for sum and mean with a weight for each vertex of a row, where no moments of few terms give the sum
/// over a node: a Gaussian of the distance, or, if packets have lengths, any kernel of these but the box.
[[nodiscard]] ReducerFactory weighted_reducers(const IndexView& index, SumColumns columns, SmoothingKernel kernel);

// Weighted sums and means of many channels over rows that are listed: each id and its weight are found once, and serve
// all channels. For small neighborhoods this takes less time than sums over nodes, which are made for each channel.
//
// A row is the sum of its terms in index order. Its rounding error grows with their number, so that large neighborhoods
// would miss the accuracy of `aggregate`; so would sums without a smoothing kernel, of which `aggregate` promises more.

/// Returns whether `sum_listed` is faster, and accurate enough. It does not depend on the rows of the query, nor on
/// `run`: the bits of a row must not depend on the others.
[[nodiscard]] bool is_better_listed(const Index& index, const SignalView& signal, const AggregateQuery& query,
                                    double radius, const Run& run);

/// Writes `result`, #rows by channels by #reductions. The query has been checked, and has a smoothing kernel.
void sum_listed(const Index& index, const SignalView& signal, const AggregateQuery& query, double radius,
                std::span<double> result, const Run& run);

}  // namespace meshhood::inline v0_1
