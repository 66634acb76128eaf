// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"

#include "exact/layout.h"

namespace meshhood::inline v0_1 {

/// A number for each vertex in index order, followed by `kLeafCapacity` zeros.
using Column = std::vector<double>;

/// Some channels of a signal, in index order.
class SignalBlock {
 public:
  /// Takes the channels `first .. first + count - 1` of a signal whose size fits the index. With `scaled`, values and
  /// weights are multiplied by a power of two each, so that the largest lies where neither squares nor sums overflow.
  /// Values that are so large that this would lose small ones are infinite; `large` has them.
  SignalBlock(const IndexView& index, const SignalView& signal, std::size_t first, std::size_t count,
              MissingValues missing, bool scaled);

  [[nodiscard]] std::size_t channels() const { return values_.size(); }

  /// With `MissingValues::Omit`, missing values are 0, and so are their weights.
  [[nodiscard]] std::vector<Column>& values() { return values_; }

  /// Return the distinct columns of weights, and which of them a channel has.
  [[nodiscard]] std::vector<Column>& weights() { return weights_; }
  [[nodiscard]] std::size_t weights_of(std::size_t channel) const { return weights_of_[channel]; }

  /// All values of a channel that has large ones, times 2^exponent. Small ones may be lost. So a row whose result is
  /// not finite has large values, and these columns have its result.
  struct LargeValues {
    std::size_t channel;
    Column values;
    int exponent;
  };
  [[nodiscard]] std::vector<LargeValues>& large() { return large_; }

  /// Multiplies the values by their weights.
  void weight_values();

  /// Return the exponents of the powers of two by which values and weights were multiplied.
  [[nodiscard]] int exponent(std::size_t channel) const { return exponents_[channel]; }
  [[nodiscard]] int weight_exponent() const { return weight_exponent_; }

 private:
  void omit_missing(std::size_t channel);
  void scale(std::size_t channel);

  std::vector<Column> values_;
  std::vector<LargeValues> large_;
  std::vector<Column> weights_;
  std::vector<std::size_t> weights_of_;
  std::vector<int> exponents_;
  int weight_exponent_ = 0;
  bool has_weights_;
};

}  // namespace meshhood::inline v0_1
