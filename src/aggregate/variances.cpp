// SPDX-License-Identifier: MIT
#include "aggregate/variances.h"

#include <cmath>
#include <limits>
#include <utility>

namespace meshhood {
namespace {

/// Of up to 32 vertices.
Spread spread_of(std::span<const double> values, const double* weighted, const double* weights) {
  double weight = 0;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    weight += weights[i];
    sum += weighted[i];
  }
  if (weight == 0) return {};
  const double mean = sum / weight;
  double deviations = 0;
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double deviation = values[i] - mean;
    deviations += weights[i] * deviation;
    squares += weights[i] * (deviation * deviation);
  }
  return Spread::of(weight, mean, deviations, squares);
}

class VarianceReducer final : public PacketReducer {
 public:
  explicit VarianceReducer(const VarianceReduction& reduction)
      : reduction_(&reduction), rows_(reduction.channels().size()) {}

  void begin(const PacketAnswer& /*packet*/) override {
    for (RowSpreads& rows : rows_) rows = {};
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (queries[k] == 0) continue;
        const Spread& spread = reduction_->channels()[i].nodes[nodes.begin + k];
        for (std::size_t row = 0; row < kPacketCapacity; ++row) {
          added_.weight[row] = (queries[k] >> row & 1U) != 0 ? spread.weight : 0;
        }
        added_.mean.fill(spread.mean);
        added_.low.fill(spread.low);
        added_.squares.fill(spread.squares);
        reduction_->kernels().merge_spreads(added_, rows_[i]);
      }
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) add_leaf(reduction_->channels()[i], vertices, queries, rows_[i]);
  }

  void write(std::size_t row, std::span<double> channels) override {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const std::size_t column = std::isfinite(rows_[i].squares[row]) ? i : reduction_->channels()[i].large;
      const RowSpreads& rows = rows_[column];
      const Spread spread{rows.weight[row], rows.mean[row], rows.low[row], rows.squares[row]};
      channels[i] = reduction_->result(reduction_->channels()[column], spread);
    }
  }

 private:
  void add_leaf(const VarianceReduction::Channel& channel, const VertexRange& vertices, const QueryWord* queries,
                RowSpreads& rows) {
    const AggregateKernels& kernels = reduction_->kernels();
    const Column& weights = reduction_->weights(channel);
    const auto part_of = [&](const Column& column) {
      return std::span(column).subspan(vertices.begin, vertices.size());
    };
    weight_sums_ = {};
    value_sums_ = {};
    kernels.add_values(part_of(weights), queries, weight_sums_);
    kernels.add_values(part_of(channel.weighted), queries, value_sums_);
    PerLane<double> means;
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      const double weight = weight_sums_.high[row];
      means[row] = weight == 0 ? 0 : value_sums_.high[row] / weight;
    }
    PerLane<double> deviations;
    PerLane<double> squares;
    kernels.sum_deviations(part_of(channel.values), &weights[vertices.begin], queries, means, deviations, squares);
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      const Spread spread = Spread::of(weight_sums_.high[row], means[row], deviations[row], squares[row]);
      added_.weight[row] = spread.weight;
      added_.mean[row] = spread.mean;
      added_.low[row] = spread.low;
      added_.squares[row] = spread.squares;
    }
    kernels.merge_spreads(added_, rows);
  }

  const VarianceReduction* reduction_;
  std::vector<RowSpreads> rows_;  // by channel
  RowSpreads added_{};
  RowSums weight_sums_{};
  RowSums value_sums_{};
};

}  // namespace

VarianceReduction::VarianceReduction(const NodeTree& tree, const AggregateKernels& kernels, SignalBlock block,
                                     const VarianceOptions& options)
    : kernels_(&kernels), options_(options) {
  std::vector<Column> values = block.values();
  std::vector<Column> large;
  for (const auto& values_of_channel : block.large()) large.push_back(values_of_channel.values);
  block.weight_values();
  weights_ = std::move(block.weights());
  const auto add = [&](Column plain, Column weighted, std::size_t channel, int exponent) {
    channels_.push_back(
        {std::move(plain), std::move(weighted), block.weights_of(channel), exponent, channels_.size(), {}});
    channels_.back().nodes = spreads_by_node(tree, channels_.back());
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    add(std::move(values[i]), std::move(block.values()[i]), i, block.exponent(i));
  }
  for (std::size_t i = 0; i < large.size(); ++i) {
    auto& [channel, weighted, exponent] = block.large()[i];
    channels_[channel].large = channels_.size();
    add(std::move(large[i]), std::move(weighted), channel, exponent);
  }
}

std::vector<Spread> VarianceReduction::spreads_by_node(const NodeTree& tree, const Channel& channel) const {
  std::vector<Spread> spreads(tree.size());
  for (NodeTree::Node node = 0; node < tree.size(); ++node) {
    if (tree.is_leaf(node)) {
      const VertexRange vertices = tree.vertices(node);
      spreads[node] = spread_of(std::span(channel.values).subspan(vertices.begin, vertices.size()),
                                &channel.weighted[vertices.begin], &weights(channel)[vertices.begin]);
    } else {
      const auto [begin, end] = tree.children(node);
      for (NodeTree::Node child = begin; child < end; ++child) spreads[node].merge(spreads[child]);
    }
  }
  return spreads;
}

double VarianceReduction::result(const Channel& channel, const Spread& spread) const {
  const double divisor = spread.weight - static_cast<double>(options_.ddof);
  if (!(divisor > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double variance = spread.squares / divisor;
  return options_.root ? std::ldexp(std::sqrt(variance), -channel.exponent)
                       : std::ldexp(variance, -2 * channel.exponent);
}

std::unique_ptr<PacketReducer> VarianceReduction::make_reducer() const {
  return std::make_unique<VarianceReducer>(*this);
}

}  // namespace meshhood
