// SPDX-License-Identifier: MIT
#include "aggregate/kernel_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "aggregate/compensated.h"
#include "aggregate/moments.h"

namespace meshhood {
namespace {

// In smaller balls, relative to the frame, products of four offsets might underflow.
constexpr double kLeastRadius = 0x1p-200;

class KernelSumReducer final : public PacketReducer {
 public:
  KernelSumReducer(const KernelSumReduction& reduction, double radius)
      : reduction_(&reduction), sums_(reduction.columns().size()), totals_(sums_.size()) {
    const double scale = reduction.index().frame.scale;
    radius_in_frame_ = radius * scale;
    centers_.unit = scale;
    if (radius > 0 && std::isfinite(radius)) {
      centers_.unit = std::ldexp(1.0, std::min(-std::ilogb(radius), 1000));
      const double in_unit = radius * centers_.unit;
      centers_.inverse_square = 1 / (in_unit * in_unit);
    }
    from_frame_ = centers_.unit / scale;
  }

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    const IndexView& index = reduction_->index();
    for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
      const std::uint32_t slot = index.slot[packet.vertices[row]];
      const Point center = index.position(leaf_of(slot), lane_of(slot));
      centers_.x[row] = center.x;
      centers_.y[row] = center.y;
      centers_.z[row] = center.z;
    }
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (queries[k] != 0) add_node(nodes.begin + static_cast<NodeTree::Node>(k), queries[k]);
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    const AggregateKernels& kernels = reduction_->kernels();
    std::visit(
        [&](auto xyz) {
          for (std::size_t k = 0; k < vertices.size(); ++k) {
            kernels.set_offsets(point(xyz, vertices.begin + k), centers_, offsets_);
            kernels.set_weights(offsets_, centers_.inverse_square, reduction_->squared(), weights_.of_vertex[k]);
          }
        },
        reduction_->index().positions);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const auto values = std::span(reduction_->columns().column(i)).subspan(vertices.begin, vertices.size());
      kernels.add_weighted(values, queries, weights_, sums_[i]);
    }
  }

  void write(std::size_t row, std::span<double> channels) override {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      totals_[i] = CompensatedSum{sums_[i].high[row], sums_[i].low[row]}.value();
    }
    for (std::size_t i = 0; i < channels.size(); ++i) channels[i] = reduction_->columns().result(i, totals_);
  }

 private:
  void add_node(NodeTree::Node node, QueryWord queries) {
    if (!has_moments_for(node)) return add_vertices(node, queries);
    reduction_->kernels().set_offsets(reduction_->tree().center(node), centers_, offsets_);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Moments moments = rescaled(reduction_->moments(i, node), from_frame_);
      reduction_->kernels().add_moments(moments, offsets_, centers_.inverse_square, reduction_->squared(), queries,
                                        sums_[i]);
    }
  }

  /// The vertices of a node that is added lie in the ball, but its sphere, whose center is rounded to floats, may be
  /// larger. Then offsets from the center are longer than the radius, and their sums would cancel.
  [[nodiscard]] bool has_moments_for(NodeTree::Node node) const {
    return radius_in_frame_ >= kLeastRadius &&
           static_cast<double>(reduction_->tree().sphere(node).radius) <= radius_in_frame_;
  }

  void add_vertices(NodeTree::Node node, QueryWord queries) {
    const NodeTree& tree = reduction_->tree();
    if (tree.is_leaf(node)) {
      PerLane<QueryWord> words;
      words.fill(queries);
      add_leaf(tree.vertices(node), words.data());
    } else {
      const auto [begin, end] = tree.children(node);
      for (NodeTree::Node child = begin; child < end; ++child) add_vertices(child, queries);
    }
  }

  const KernelSumReduction* reduction_;
  double radius_in_frame_;
  double from_frame_;
  PacketCenters centers_{};
  Offsets offsets_{};
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
  std::vector<double> totals_;
};

}  // namespace

KernelSumReduction::KernelSumReduction(const IndexView& index, const NodeTree& tree, const AggregateKernels& kernels,
                                       SumColumns columns, bool squared)
    : index_(&index), tree_(&tree), kernels_(&kernels), columns_(std::move(columns)), squared_(squared) {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    moments_.push_back(moments_by_node(index, tree, columns_.column(i)));
}

std::unique_ptr<PacketReducer> KernelSumReduction::make_reducer(double radius) const {
  return std::make_unique<KernelSumReducer>(*this, radius);
}

}  // namespace meshhood
