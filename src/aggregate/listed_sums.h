// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/aggregate.h"

namespace meshhood::inline v0_1 {

/// Weighted sums and means of many channels over rows that are listed: each id and its weight are found once, and serve
/// all channels. For small neighborhoods this takes less time than sums over nodes, which are made for each channel.
///
/// A row is the sum of its terms in index order. Its rounding error grows with their number, so that large
/// neighborhoods would miss the accuracy of `aggregate`, and so would sums without a smoothing kernel, of which it is
/// greater.

/// Whether `sum_listed` is the faster way, and as accurate. Depends on the index, the radius and the signal alone, not
/// on the rows: the bits of a row must not depend on the others.
[[nodiscard]] bool is_better_listed(const Index& index, const SignalView& signal, const AggregateQuery& query,
                                    double radius);

/// Writes `result`, #rows by channels by #reductions. The query has been checked, and has a smoothing kernel.
void sum_listed(const Index& index, const SignalView& signal, const AggregateQuery& query, double radius,
                std::span<double> result, const Run& run);

}  // namespace meshhood::inline v0_1
