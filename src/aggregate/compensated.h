// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace meshhood {

/// A sum as `high + low`; see `RowSums`.
struct CompensatedSum {
  double high = 0;
  double low = 0;

  void add(double addend) {
    const double sum = high + addend;
    const double rounded = sum - high;
    low += (high - (sum - rounded)) + (addend - rounded);
    high = sum;
  }

  /// The sum, rounded. Where it is infinite, `low` is NaN.
  [[nodiscard]] double value() const { return std::isfinite(low) ? high + low : high; }
};

}  // namespace meshhood
