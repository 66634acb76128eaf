// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "aggregate/reducers.h"
#include "exact/layout.h"
#include "simd/aggregate.h"

namespace meshhood::inline v0_1 {
namespace {

struct WeightedSums {
  const IndexView* index;
  SumColumns columns;
  SmoothingKernel kernel;
};

class WeightedReducer final : public PacketReducer {
 public:
  explicit WeightedReducer(const WeightedSums& asked) : asked_(&asked), sums_(asked.columns.size()) {}

  [[nodiscard]] bool takes_nodes() const override { return false; }

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    lengths_ = packet.lengths;
    lengths_ != nullptr ? set_divisors(packet) : set_centers(packet);
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    lengths_ != nullptr ? weigh_by_length(vertices, queries) : weigh_by_distance(vertices, queries);
    asked_->columns.add_weighted(*kernels_, vertices, queries, weights_, sums_);
  }

  void write(std::size_t row, std::span<double> channels) override { asked_->columns.write(sums_, row, channels); }

 private:
  void set_divisors(const PacketAnswer& packet) {
    divisors_.fill(1);
    for (std::size_t i = 0; i < packet.radii.size(); ++i) {
      // Within a radius of 0 all lengths are 0, and all weights 1.
      divisors_[i] = packet.radii[i] > 0 ? packet.radii[i] : kInfinity;
    }
  }

  void set_centers(const PacketAnswer& packet) {
    for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
      centers_.set(row, asked_->index->position_of(packet.vertices[row]));
      // Within a radius of 0 all weights are 1. The least radii have no finite inverse.
      const double radius = packet.radii[row];
      centers_.unit[row] = radius > 0 ? std::min(1 / radius, std::numeric_limits<double>::max()) : 0;
    }
  }

  void weigh_by_length(const VertexRange& vertices, const QueryWord* queries) {
    lengths_->select(leaf_of(asked_->index->slot_at(vertices.begin)));
    for (unsigned lane = 0; lane < vertices.size(); ++lane) {
      if (queries[lane] == 0) continue;
      kernels_->set_path_weights(lengths_->at(lane), divisors_, asked_->kernel, weights_[lane]);
    }
  }

  void weigh_by_distance(const VertexRange& vertices, const QueryWord* queries) {
    std::visit(
        [&](auto xyz) {
          for (std::size_t k = 0; k < vertices.size(); ++k) points_[k] = point(xyz, vertices.begin + k);
        },
        asked_->index->positions);
    kernels_->set_gaussians(std::span(points_).first(vertices.size()), queries, centers_, weights_);
  }

  const WeightedSums* asked_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  PacketLengths* lengths_ = nullptr;  // of the packet; null if distances give the weights
  PathLengths divisors_{};
  PacketCenters centers_{};
  std::array<Point, kLeafCapacity> points_{};
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

}  // namespace

ReducerFactory weighted_reducers(const IndexView& index, SumColumns columns, SmoothingKernel kernel) {
  return factory_of<WeightedReducer>(WeightedSums{&index, std::move(columns), kernel});
}

}  // namespace meshhood::inline v0_1
