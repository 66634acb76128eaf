// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "aggregate/reducers.h"
#include "shared/distance.h"
#include "simd/aggregate.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr double kAboveAll = kInfinity;

/// The minima of each node; for the maximum, those of negated values.
struct Minima {
  struct Channel {
    Column values;
    std::vector<double> of_nodes;
  };

  Minima(const NodeTree& tree, SignalBlock block, bool maximum, MissingValues missing);

  /// Returns NaN if a NaN propagates, or if there is nothing else.
  [[nodiscard]] double minimum_of(std::span<const double> values) const;

  bool maximum;
  bool propagates;
  std::vector<Channel> channels;
};

Minima::Minima(const NodeTree& tree, SignalBlock block, bool is_maximum, MissingValues missing)
    : maximum(is_maximum), propagates(missing == MissingValues::Propagate) {
  for (Column& values : block.values()) {
    if (maximum) {
      for (double& value : values) value = -value;
    }
    std::vector<double> minima =
        reduced_by_node(tree, values, [&](std::span<const double> some) { return minimum_of(some); });
    channels.push_back({std::move(values), std::move(minima)});
  }
}

double Minima::minimum_of(std::span<const double> values) const {
  double least = kNan;
  for (const double value : values) {
    if (std::isnan(value)) {
      if (propagates) return kNan;
    } else if (!(least <= value)) {
      least = value;
    }
  }
  return least;
}

class MinimumReducer final : public PacketReducer {
 public:
  explicit MinimumReducer(const Minima& minima) : minima_(&minima), rows_(minima.channels.size()) {}

  void begin(const PacketAnswer& /*packet*/) override {
    for (Rows& rows : rows_) {
      rows.minima.fill(kAboveAll);
      rows.with_nan = 0;
      rows.with_number = 0;
    }
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      lower(i, std::span(minima_->channels[i].of_nodes).subspan(nodes.begin, nodes.size()), queries);
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto values = std::span(minima_->channels[i].values).subspan(vertices.begin, vertices.size());
      lower(i, values, queries);
    }
  }

  void write(std::size_t row, std::span<double> channels) override {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const Rows& rows = rows_[i];
      const QueryWord nan = ~rows.with_number | (minima_->propagates ? rows.with_nan : 0);
      const bool is_nan = (nan >> row & 1U) != 0;
      channels[i] = is_nan ? kNan : minima_->maximum ? -rows.minima[row] : rows.minima[row];
    }
  }

 private:
  struct Rows {
    PerLane<double> minima;
    QueryWord with_nan;     // the rows that have a NaN
    QueryWord with_number;  // the rows that have another value
  };

  void lower(std::size_t channel, std::span<const double> values, const QueryWord* queries) {
    Rows& rows = rows_[channel];
    PerLane<double> numbers;
    PerLane<QueryWord> words;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool is_nan = std::isnan(values[k]);
      (is_nan ? rows.with_nan : rows.with_number) |= queries[k];
      numbers[k] = is_nan ? 0 : values[k];
      words[k] = is_nan ? 0 : queries[k];
    }
    kernels_->lower_minima(std::span(numbers).first(values.size()), words.data(), rows.minima);
  }

  const Minima* minima_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  std::vector<Rows> rows_;  // by channel
};

}  // namespace

ReducerFactory minimum_reducers(const NodeTree& tree, SignalBlock block, bool maximum, MissingValues missing) {
  return factory_of<MinimumReducer>(Minima(tree, std::move(block), maximum, missing));
}

}  // namespace meshhood::inline v0_1
