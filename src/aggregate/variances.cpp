// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "aggregate/reducers.h"
#include "simd/aggregate.h"

namespace meshhood::inline v0_1 {
namespace {

/// The weight, the mean and the sum of squared deviations from the mean, of a set of values. Two sets are merged
/// without the cancellation of `sum of x^2 - n mean^2`: T. F. Chan, G. H. Golub, R. J. LeVeque, "Algorithms for
/// Computing the Sample Variance: Analysis and Recommendations", The American Statistician 37 (1983), eq. 2.1. The mean
/// is kept as `mean + low`, because where it is large compared with the deviations, its rounding error would dominate
/// the difference of means.
struct Spread {
  double weight = 0;
  double mean = 0;
  double low = 0;
  double squares = 0;

  /// Makes a spread from a sum of weights, a mean that is rounded, and the weighted sums of deviations from it and of
  /// their squares, by the corrected two-pass algorithm (loc. cit., eq. 1.7).
  [[nodiscard]] static Spread of(double weight, double mean, double deviations, double squares) {
    if (weight == 0) return {};
    return {weight, mean, deviations / weight, std::max(squares - deviations * (deviations / weight), 0.0)};
  }

  void merge(const Spread& other) {
    if (other.weight == 0) return;
    if (weight == 0) {
      *this = other;  // the difference of means would round
      return;
    }
    const double sum = weight + other.weight;
    const double step = (other.mean - mean) + (other.low - low);
    const double share = other.weight / sum;
    squares += other.squares + step * step * weight * share;
    CompensatedSum moved{mean, low};
    moved.add(step * share);
    mean = moved.high;
    low = moved.low;
    weight = sum;
  }
};

/// Returns the spread of up to 32 vertices.
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

/// Holds the values of all vertices and the spreads of all nodes.
struct Spreads {
  struct Channel {
    Column values;
    Column weighted;      // values times weights
    std::size_t weights;  // its column
    int exponent;         // of two, by which values were multiplied
    std::size_t large;    // the channel of rows whose squares are not finite: see `SignalBlock::large`
    std::vector<Spread> nodes;
  };

  Spreads(const NodeTree& tree, SignalBlock block, const VarianceOptions& asked);

  [[nodiscard]] std::vector<Spread> by_node(const NodeTree& tree, const Channel& channel) const;
  [[nodiscard]] double result(const Channel& channel, const Spread& spread) const;

  VarianceOptions options;
  std::vector<Column> weights;
  std::vector<Channel> channels;
};

Spreads::Spreads(const NodeTree& tree, SignalBlock block, const VarianceOptions& asked) : options(asked) {
  std::vector<Column> values = block.values();
  std::vector<Column> large;
  for (const auto& values_of_channel : block.large()) large.push_back(values_of_channel.values);
  block.weight_values();
  weights = std::move(block.weights());
  const auto add = [&](Column plain, Column weighted, std::size_t channel, int exponent) {
    channels.push_back(
        {std::move(plain), std::move(weighted), block.weights_of(channel), exponent, channels.size(), {}});
    channels.back().nodes = by_node(tree, channels.back());
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    add(std::move(values[i]), std::move(block.values()[i]), i, block.exponent(i));
  }
  for (std::size_t i = 0; i < large.size(); ++i) {
    auto& [channel, weighted, exponent] = block.large()[i];
    channels[channel].large = channels.size();
    add(std::move(large[i]), std::move(weighted), channel, exponent);
  }
}

std::vector<Spread> Spreads::by_node(const NodeTree& tree, const Channel& channel) const {
  std::vector<Spread> spreads(tree.size());
  for (NodeTree::Node node = 0; node < tree.size(); ++node) {
    if (tree.is_leaf(node)) {
      const VertexRange vertices = tree.vertices(node);
      spreads[node] = spread_of(std::span(channel.values).subspan(vertices.begin, vertices.size()),
                                &channel.weighted[vertices.begin], &weights[channel.weights][vertices.begin]);
    } else {
      const auto [begin, end] = tree.children(node);
      for (NodeTree::Node child = begin; child < end; ++child) spreads[node].merge(spreads[child]);
    }
  }
  return spreads;
}

double Spreads::result(const Channel& channel, const Spread& spread) const {
  const double divisor = spread.weight - static_cast<double>(options.ddof);
  if (!(divisor > 0)) return kNan;
  const double variance = spread.squares / divisor;
  return options.root ? std::ldexp(std::sqrt(variance), -channel.exponent)
                      : std::ldexp(variance, -2 * channel.exponent);
}

class VarianceReducer final : public PacketReducer {
 public:
  explicit VarianceReducer(const Spreads& spreads) : spreads_(&spreads), rows_(spreads.channels.size()) {}

  void begin(const PacketAnswer& /*packet*/) override {
    for (RowSpreads& rows : rows_) rows = {};
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (queries[k] == 0) continue;
        const Spread& spread = spreads_->channels[i].nodes[nodes.begin + k];
        for (std::size_t row = 0; row < kPacketCapacity; ++row) {
          added_.weight[row] = (queries[k] >> row & 1U) != 0 ? spread.weight : 0;
        }
        added_.mean.fill(spread.mean);
        added_.low.fill(spread.low);
        added_.squares.fill(spread.squares);
        kernels_->merge_spreads(added_, rows_[i]);
      }
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) add_leaf(spreads_->channels[i], vertices, queries, rows_[i]);
  }

  void write(std::size_t row, std::span<double> channels) override {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const std::size_t column = std::isfinite(rows_[i].squares[row]) ? i : spreads_->channels[i].large;
      const RowSpreads& rows = rows_[column];
      const Spread spread{rows.weight[row], rows.mean[row], rows.low[row], rows.squares[row]};
      channels[i] = spreads_->result(spreads_->channels[column], spread);
    }
  }

 private:
  void add_leaf(const Spreads::Channel& channel, const VertexRange& vertices, const QueryWord* queries,
                RowSpreads& rows) {
    const Column& weights = spreads_->weights[channel.weights];
    const auto part_of = [&](const Column& column) {
      return std::span(column).subspan(vertices.begin, vertices.size());
    };
    weight_sums_ = {};
    value_sums_ = {};
    kernels_->add_values(part_of(weights), queries, weight_sums_);
    kernels_->add_values(part_of(channel.weighted), queries, value_sums_);
    PerLane<double> means;
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      const double weight = weight_sums_.high[row];
      means[row] = weight == 0 ? 0 : value_sums_.high[row] / weight;
    }
    PerLane<double> deviations;
    PerLane<double> squares;
    kernels_->sum_deviations(part_of(channel.values), &weights[vertices.begin], queries, means, deviations, squares);
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      const Spread spread = Spread::of(weight_sums_.high[row], means[row], deviations[row], squares[row]);
      added_.weight[row] = spread.weight;
      added_.mean[row] = spread.mean;
      added_.low[row] = spread.low;
      added_.squares[row] = spread.squares;
    }
    kernels_->merge_spreads(added_, rows);
  }

  const Spreads* spreads_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  std::vector<RowSpreads> rows_;  // by channel
  RowSpreads added_{};
  RowSums weight_sums_{};
  RowSums value_sums_{};
};

}  // namespace

ReducerFactory variance_reducers(const NodeTree& tree, SignalBlock block, const VarianceOptions& options) {
  return factory_of<VarianceReducer>(Spreads(tree, std::move(block), options));
}

}  // namespace meshhood::inline v0_1
