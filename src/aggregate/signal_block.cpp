// SPDX-License-Identifier: MIT
#include "aggregate/signal_block.h"

#include <algorithm>
#include <cmath>

namespace meshhood::inline v0_1 {
namespace {

// The largest magnitude of a column gets this binary exponent: then 2^32 squares of it, with such weights, do not
// overflow, and squares of numbers 2^750 times smaller do not underflow.
constexpr int kLargestExponent = 300;

/// Returns the exponent of the power of two that brings the largest finite magnitude of a column there.
int exponent_of(const Column& column) {
  double largest = 0;
  for (const double value : column) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest == 0 ? 0 : kLargestExponent - std::ilogb(largest);
}

/// Multiplies by 2^exponent, in two steps, because 2^exponent may be too large for a number. It is exact, unless a
/// product underflows.
void multiply(Column& column, int exponent) {
  if (exponent == 0) return;
  const double first = std::ldexp(1.0, exponent / 2);
  const double second = std::ldexp(1.0, exponent - exponent / 2);
  for (double& value : column) value = value * first * second;
}

/// Makes values that are too large for sums of squares infinite.
void drop_large(Column& column) {
  const double bound = std::ldexp(1.0, kLargestExponent + 1);
  for (double& value : column) {
    if (std::abs(value) >= bound) value = std::copysign(kInfinity, value);
  }
}

/// Returns every `stride`-th number from `first` on, in index order.
Column in_index_order(const IndexView& index, const ValuesView& numbers, std::size_t first, std::size_t stride) {
  const std::size_t vertices = index.vertex_count();
  Column column(vertices + kLeafCapacity);
  numbers.visit([&](auto all) {
    for (std::size_t i = 0; i < vertices; ++i) {
      column[i] = static_cast<double>(all[first + stride * index.id(i)]);
    }
  });
  return column;
}

/// Sets the values of vertices of weight 0 to 0, so that a NaN or an infinite one has no effect.
void clear_unweighted(Column& values, const Column& weights) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (weights[i] == 0) values[i] = 0;
  }
}

Column ones(const IndexView& index) {
  Column column(index.vertex_count() + kLeafCapacity);
  std::fill_n(column.begin(), index.vertex_count(), 1.0);
  return column;
}

}  // namespace

SignalBlock::SignalBlock(const IndexView& index, const SignalView& signal, std::size_t first, std::size_t count,
                         MissingValues missing, bool scaled)
    : weights_of_(count, 0), exponents_(count, 0), has_weights_(!signal.weights.empty()) {
  weights_.push_back(has_weights_ ? in_index_order(index, signal.weights, 0, 1) : ones(index));
  if (scaled && has_weights_) {
    weight_exponent_ = exponent_of(weights_.front());
    multiply(weights_.front(), weight_exponent_);
  }
  for (std::size_t channel = 0; channel < count; ++channel) {
    values_.push_back(in_index_order(index, signal.values, first + channel, signal.channels));
    if (has_weights_) clear_unweighted(values_.back(), weights_.front());
    if (missing == MissingValues::Omit) omit_missing(channel);
    if (scaled) scale(channel);
  }
}

/// Scales a channel. If it has values that are too large, a second column gets all values, scaled down.
void SignalBlock::scale(std::size_t channel) {
  const int exponent = exponent_of(values_[channel]);
  if (exponent >= 0) {
    exponents_[channel] = exponent;
    multiply(values_[channel], exponent);
    return;
  }
  large_.push_back({channel, values_[channel], exponent});
  multiply(large_.back().values, exponent);
  drop_large(values_[channel]);
}

void SignalBlock::weight_values() {
  if (!has_weights_) return;
  const auto weigh = [&](Column& values, std::size_t channel) {
    const Column& weights = weights_[weights_of_[channel]];
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= weights[i];
  };
  for (std::size_t channel = 0; channel < channels(); ++channel) weigh(values_[channel], channel);
  for (LargeValues& large : large_) weigh(large.values, large.channel);
}

void SignalBlock::omit_missing(std::size_t channel) {
  Column& values = values_[channel];
  if (std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) return;
  Column weights = weights_.front();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) continue;
    values[i] = 0;
    weights[i] = 0;
  }
  weights_of_[channel] = weights_.size();
  weights_.push_back(std::move(weights));
}

}  // namespace meshhood::inline v0_1
