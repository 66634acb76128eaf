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

/// Sum and mean with weights that fall with the length along the edges, of packets that have lengths.
class LengthReduction final : public Reduction {
 public:
  /// With a kernel that is not the box. Borrows the index.
  LengthReduction(const IndexView& index, const AggregateKernels& kernels, SumColumns columns, SmoothingKernel kernel)
      : index_(&index), kernels_(&kernels), columns_(std::move(columns)), kernel_(kernel) {}

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
};

}  // namespace meshhood
