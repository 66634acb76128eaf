// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "aggregate/compensated.h"
#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/signal_block.h"
#include "simd/aggregate.h"

namespace meshhood {

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

  /// From a sum of weights, a mean that is rounded, and the weighted sums of deviations from it and of their squares:
  /// the corrected two-pass algorithm (loc. cit., eq. 1.7).
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

/// How the variance follows from a spread.
struct VarianceOptions {
  bool root;      ///< the standard deviation
  unsigned ddof;  ///< see `AggregateQuery::ddof`
};

/// Variance and standard deviation.
class VarianceReduction final : public Reduction {
 public:
  VarianceReduction(const NodeTree& tree, const AggregateKernels& kernels, SignalBlock block,
                    const VarianceOptions& options);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  struct Channel {
    Column values;
    Column weighted;      // values times weights
    std::size_t weights;  // its column
    int exponent;         // of two, by which values were multiplied
    std::size_t large;    // the channel of rows whose squares are not finite: see `SignalBlock::large`
    std::vector<Spread> nodes;
  };

  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] std::span<const Channel> channels() const { return channels_; }
  [[nodiscard]] const Column& weights(const Channel& channel) const { return weights_[channel.weights]; }
  [[nodiscard]] double result(const Channel& channel, const Spread& spread) const;

 private:
  [[nodiscard]] std::vector<Spread> spreads_by_node(const NodeTree& tree, const Channel& channel) const;

  const AggregateKernels* kernels_;
  VarianceOptions options_;
  std::vector<Column> weights_;
  std::vector<Channel> channels_;
};

}  // namespace meshhood
