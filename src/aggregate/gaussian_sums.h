// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "aggregate/packet_reducer.h"
#include "aggregate/sums.h"
#include "exact/layout.h"
#include "simd/aggregate.h"

namespace meshhood {

/// Sum and mean with weights that fall with the distance as a Gaussian. No moments of few terms give such a sum over a
/// node, so that each vertex gets its weight.
class GaussianReduction final : public Reduction {
 public:
  /// Borrows the index.
  GaussianReduction(const IndexView& index, const AggregateKernels& kernels, SumColumns columns)
      : index_(&index), kernels_(&kernels), columns_(std::move(columns)) {}

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  [[nodiscard]] const IndexView& index() const { return *index_; }
  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] const SumColumns& columns() const { return columns_; }

 private:
  const IndexView* index_;
  const AggregateKernels* kernels_;
  SumColumns columns_;
};

}  // namespace meshhood
