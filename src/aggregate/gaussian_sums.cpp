// SPDX-License-Identifier: MIT
#include "aggregate/gaussian_sums.h"

#include <algorithm>
#include <array>
#include <limits>
#include <variant>
#include <vector>

namespace meshhood {
namespace {

class GaussianReducer final : public PacketReducer {
 public:
  explicit GaussianReducer(const GaussianReduction& reduction)
      : reduction_(&reduction), sums_(reduction.columns().size()) {}

  [[nodiscard]] bool takes_nodes() const override { return false; }

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    const IndexView& index = reduction_->index();
    for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
      const std::uint32_t slot = index.slot[packet.vertices[row]];
      centers_.set(row, index.position(leaf_of(slot), lane_of(slot)));
      // Within a radius of 0 all weights are 1. The least radii have no finite inverse.
      const double radius = packet.radii[row];
      centers_.unit[row] = radius > 0 ? std::min(1 / radius, std::numeric_limits<double>::max()) : 0;
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    const AggregateKernels& kernels = reduction_->kernels();
    std::visit(
        [&](auto xyz) {
          for (std::size_t k = 0; k < vertices.size(); ++k) points_[k] = point(xyz, vertices.begin + k);
        },
        reduction_->index().positions);
    kernels.set_gaussians(std::span(points_).first(vertices.size()), queries, centers_, weights_);
    reduction_->columns().add_weighted(kernels, vertices, queries, weights_, sums_);
  }

  void write(std::size_t row, std::span<double> channels) override {
    reduction_->columns().write(sums_, row, channels);
  }

 private:
  const GaussianReduction* reduction_;
  PacketCenters centers_{};
  std::array<Point, kLeafCapacity> points_{};
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

}  // namespace

std::unique_ptr<PacketReducer> GaussianReduction::make_reducer() const {
  return std::make_unique<GaussianReducer>(*this);
}

}  // namespace meshhood
