// SPDX-License-Identifier: MIT
#include "aggregate/length_sums.h"

#include <limits>
#include <vector>

namespace meshhood {
namespace {

class LengthReducer final : public PacketReducer {
 public:
  explicit LengthReducer(const LengthReduction& reduction)
      : reduction_(&reduction), sums_(reduction.columns().size()) {}

  [[nodiscard]] bool takes_nodes() const override { return false; }

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    lengths_ = packet.lengths;
    divisors_.fill(1);
    for (std::size_t i = 0; i < packet.radii.size(); ++i) {
      // Within a radius of 0 all lengths are 0, and all weights 1.
      divisors_[i] = packet.radii[i] > 0 ? packet.radii[i] : std::numeric_limits<double>::infinity();
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    const IndexView& index = reduction_->index();
    lengths_->select(leaf_of(index.slot_at(vertices.begin)));
    for (unsigned lane = 0; lane < vertices.size(); ++lane) {
      if (queries[lane] == 0) continue;
      reduction_->kernels().set_path_weights(lengths_->at(lane), divisors_, reduction_->kernel(), weights_[lane]);
    }
    reduction_->columns().add_weighted(reduction_->kernels(), vertices, queries, weights_, sums_);
  }

  void write(std::size_t row, std::span<double> channels) override {
    reduction_->columns().write(sums_, row, channels);
  }

 private:
  const LengthReduction* reduction_;
  PacketLengths* lengths_ = nullptr;  // of the packet
  PathLengths divisors_{};
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

}  // namespace

std::unique_ptr<PacketReducer> LengthReduction::make_reducer() const { return std::make_unique<LengthReducer>(*this); }

}  // namespace meshhood
