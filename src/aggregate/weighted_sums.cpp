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

class WeightedReducer : public PacketReducer {
 public:
  explicit WeightedReducer(const WeightedSums& asked) : asked_(&asked), sums_(asked.columns.size()) {}

  [[nodiscard]] bool takes_nodes() const override { return false; }

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    set_packet(packet);
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    set_weights(vertices, queries, weights_);
    asked_->columns.add_weighted(kernels(), vertices, queries, weights_, sums_);
  }

  void write(std::size_t row, std::span<double> channels) override { asked_->columns.write(sums_, row, channels); }

 protected:
  [[nodiscard]] const WeightedSums& asked() const { return *asked_; }
  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }

 private:
  virtual void set_packet(const PacketAnswer& packet) = 0;

  /// Of the vertices of a leaf, in the rows of their words.
  virtual void set_weights(const VertexRange& vertices, const QueryWord* queries, RowWeights& weights) = 0;

  const WeightedSums* asked_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

class WeightedByDistance final : public WeightedReducer {
 public:
  using WeightedReducer::WeightedReducer;

 private:
  void set_packet(const PacketAnswer& packet) override {
    const IndexView& index = *asked().index;
    for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
      centers_.set(row, index.position_of(packet.vertices[row]));
      // Within a radius of 0 all weights are 1. The least radii have no finite inverse.
      const double radius = packet.radii[row];
      centers_.unit[row] = radius > 0 ? std::min(1 / radius, std::numeric_limits<double>::max()) : 0;
    }
  }

  void set_weights(const VertexRange& vertices, const QueryWord* queries, RowWeights& weights) override {
    std::visit(
        [&](auto xyz) {
          for (std::size_t k = 0; k < vertices.size(); ++k) points_[k] = point(xyz, vertices.begin + k);
        },
        asked().index->positions);
    kernels().set_gaussians(std::span(points_).first(vertices.size()), queries, centers_, weights);
  }

  PacketCenters centers_{};
  std::array<Point, kLeafCapacity> points_{};
};

class WeightedByLength final : public WeightedReducer {
 public:
  using WeightedReducer::WeightedReducer;

 private:
  void set_packet(const PacketAnswer& packet) override {
    lengths_ = packet.lengths;
    divisors_.fill(1);
    for (std::size_t i = 0; i < packet.radii.size(); ++i) {
      // Within a radius of 0 all lengths are 0, and all weights 1.
      divisors_[i] = packet.radii[i] > 0 ? packet.radii[i] : kInfinity;
    }
  }

  void set_weights(const VertexRange& vertices, const QueryWord* queries, RowWeights& weights) override {
    lengths_->select(leaf_of(asked().index->slot_at(vertices.begin)));
    for (unsigned lane = 0; lane < vertices.size(); ++lane) {
      if (queries[lane] == 0) continue;
      kernels().set_path_weights(lengths_->at(lane), divisors_, asked().kernel, weights[lane]);
    }
  }

  PacketLengths* lengths_ = nullptr;  // of the packet
  PathLengths divisors_{};
};

}  // namespace

ReducerFactory weighted_reducers(const IndexView& index, SumColumns columns, SmoothingKernel kernel, bool has_lengths) {
  WeightedSums sums{&index, std::move(columns), kernel};
  return has_lengths ? factory_of<WeightedByLength>(std::move(sums)) : factory_of<WeightedByDistance>(std::move(sums));
}

}  // namespace meshhood::inline v0_1
