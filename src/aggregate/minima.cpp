// SPDX-License-Identifier: MIT
#include "aggregate/minima.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shared/distance.h"

namespace meshhood {
namespace {

constexpr double kAboveAll = std::numeric_limits<double>::infinity();

class MinimumReducer final : public PacketReducer {
 public:
  explicit MinimumReducer(const MinimumReduction& reduction)
      : reduction_(&reduction), rows_(reduction.channels().size()) {}

  void begin(const PacketAnswer& /*packet*/) override {
    for (Rows& rows : rows_) {
      rows.minima.fill(kAboveAll);
      rows.with_nan = 0;
      rows.with_number = 0;
    }
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      lower(i, std::span(reduction_->channels()[i].node_minima).subspan(nodes.begin, nodes.size()), queries);
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto values = std::span(reduction_->channels()[i].values).subspan(vertices.begin, vertices.size());
      lower(i, values, queries);
    }
  }

  void write(std::size_t row, std::span<double> channels) override {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const Rows& rows = rows_[i];
      const QueryWord nan = ~rows.with_number | (reduction_->propagates() ? rows.with_nan : 0);
      const bool is_nan = (nan >> row & 1U) != 0;
      channels[i] = is_nan ? kNan : reduction_->is_maximum() ? -rows.minima[row] : rows.minima[row];
    }
  }

 private:
  struct Rows {
    PerLane<double> minima;
    QueryWord with_nan;     // the rows that have a NaN
    QueryWord with_number;  // the rows that have another value
  };

  void lower(std::size_t channel, std::span<const double> values, const QueryWord* queries) {
    Rows& rows = rows_[channel];
    PerLane<double> numbers{};
    PerLane<QueryWord> words{};
    if (reduction_->channels()[channel].has_nan) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        const bool is_nan = std::isnan(values[k]);
        (is_nan ? rows.with_nan : rows.with_number) |= queries[k];
        numbers[k] = is_nan ? 0 : values[k];
        words[k] = is_nan ? 0 : queries[k];
      }
      queries = words.data();
      values = std::span(numbers).first(values.size());
    } else {
      for (std::size_t k = 0; k < values.size(); ++k) rows.with_number |= queries[k];
    }
    reduction_->kernels().lower_minima(values, queries, rows.minima);
  }

  const MinimumReduction* reduction_;
  std::vector<Rows> rows_;  // by channel
};

}  // namespace

MinimumReduction::MinimumReduction(const NodeTree& tree, const AggregateKernels& kernels, SignalBlock block,
                                   bool maximum, MissingValues missing)
    : kernels_(&kernels), maximum_(maximum), missing_(missing) {
  for (Column& values : block.values()) {
    if (maximum) {
      for (double& value : values) value = -value;
    }
    std::vector<double> minima(tree.size());
    for (NodeTree::Node node = 0; node < tree.size(); ++node) {
      if (tree.is_leaf(node)) {
        const VertexRange vertices = tree.vertices(node);
        minima[node] = minimum_of(std::span(values).subspan(vertices.begin, vertices.size()));
      } else {
        const auto [begin, end] = tree.children(node);
        minima[node] = minimum_of(std::span(minima).subspan(begin, end - begin));
      }
    }
    const bool has_nan = std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
    channels_.push_back({std::move(values), has_nan, std::move(minima)});
  }
}

/// NaN if a NaN propagates, or if there is nothing else.
double MinimumReduction::minimum_of(std::span<const double> values) const {
  double least = kNan;
  for (const double value : values) {
    if (std::isnan(value)) {
      if (propagates()) return kNan;
    } else if (!(least <= value)) {
      least = value;
    }
  }
  return least;
}

std::unique_ptr<PacketReducer> MinimumReduction::make_reducer() const {
  return std::make_unique<MinimumReducer>(*this);
}

}  // namespace meshhood
