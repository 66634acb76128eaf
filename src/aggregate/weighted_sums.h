// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "meshhood/aggregate.h"

#include "aggregate/packet_reducer.h"
#include "aggregate/sums.h"
#include "exact/layout.h"
#include "simd/aggregate.h"

namespace meshhood {

/// Sum and mean with a weight for each vertex of a row, where no moments of few terms give the sum over a node: weights
/// that fall with the distance as a Gaussian, or by any kernel with the length along the edges.
class WeightedReduction final : public Reduction {
 public:
  /// `has_lengths`: of packets that have lengths. Otherwise the kernel is the Gaussian; it is never the box. Borrows
  /// the index.
  WeightedReduction(const IndexView& index, const AggregateKernels& kernels, SumColumns columns, SmoothingKernel kernel,
                    bool has_lengths)
      : index_(&index), kernels_(&kernels), columns_(std::move(columns)), kernel_(kernel), has_lengths_(has_lengths) {}

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  [[nodiscard]] const IndexView& index() const { return *index_; }
  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] const SumColumns& columns() const { return columns_; }
  [[nodiscard]] SmoothingKernel kernel() const { return kernel_; }

 private:
  const IndexView* index_;
  const AggregateKernels* kernels_;
  SumColumns columns_;
  SmoothingKernel kernel_;
  bool has_lengths_;
};

}  // namespace meshhood
