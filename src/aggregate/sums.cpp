// SPDX-License-Identifier: MIT
#include "aggregate/sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "aggregate/reducers.h"

namespace meshhood::inline v0_1 {
namespace {

double sum_of(std::span<const double> values) {
  CompensatedSum sum;
  for (const double value : values) sum.add(value);
  return sum.value();
}

/// Returns the words of values, those of infinite ones without the rows in which their weight is 0.
std::array<QueryWord, kLeafCapacity> with_weights(std::span<const double> values, const QueryWord* queries,
                                                  const RowWeights& weights) {
  std::array<QueryWord, kLeafCapacity> words{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    words[k] = queries[k];
    if (!std::isinf(values[k])) continue;
    for_each_lane(words[k], [&](unsigned row) { words[k] &= ~(QueryWord{weights[k][row] == 0} << row); });
  }
  return words;
}

struct SumTables {
  SumColumns columns;
  std::vector<std::vector<double>> of_nodes;  // by column
};

class SumReducer final : public PacketReducer {
 public:
  explicit SumReducer(const SumTables& tables) : tables_(&tables), sums_(tables.columns.size()) {}

  void begin(const PacketAnswer& /*packet*/) override {
    for (RowSums& sums : sums_) sums = {};
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const auto values = std::span(tables_->of_nodes[i]).subspan(nodes.begin, nodes.size());
      kernels_->add_values(values, queries, sums_[i]);
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const auto values = std::span(tables_->columns.column(i)).subspan(vertices.begin, vertices.size());
      kernels_->add_values(values, queries, sums_[i]);
    }
  }

  void write(std::size_t row, std::span<double> channels) override { tables_->columns.write(sums_, row, channels); }

 private:
  const SumTables* tables_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  std::vector<RowSums> sums_;  // by column
};

}  // namespace

SumColumns::SumColumns(SignalBlock block, Reduce reduce) : reduce_(reduce) {
  const std::size_t channels = block.channels();
  if (reduce != Reduce::Count) {
    block.weight_values();
    columns_ = std::move(block.values());
  }
  const std::size_t first_large = columns_.size();
  if (reduce != Reduce::Count) {
    for (SignalBlock::LargeValues& large : block.large()) columns_.push_back(std::move(large.values));
  }
  const std::size_t first_weights = columns_.size();
  if (reduce != Reduce::Sum) {
    for (Column& weights : block.weights()) columns_.push_back(std::move(weights));
  }
  const auto is_infinite = [](double value) { return std::isinf(value); };
  for (const Column& column : columns_) has_infinite_.push_back(std::ranges::any_of(column, is_infinite));
  const int weight_exponent = reduce == Reduce::Sum ? block.weight_exponent() : 0;
  for (std::size_t i = 0; i < channels; ++i) {
    const Values values{i, -(block.exponent(i) + weight_exponent)};
    channels_.push_back({values, values, first_weights + block.weights_of(i)});
  }
  for (std::size_t i = 0; i < block.large().size(); ++i) {
    const auto& large = block.large()[i];
    channels_[large.channel].large = {first_large + i, -(large.exponent + weight_exponent)};
  }
}

void SumColumns::add_weighted(const AggregateKernels& kernels, const VertexRange& vertices, const QueryWord* queries,
                              const RowWeights& weights, std::span<RowSums> sums) const {
  std::array<QueryWord, kLeafCapacity> words{};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto values = std::span(columns_[i]).subspan(vertices.begin, vertices.size());
    if (has_infinite_[i]) words = with_weights(values, queries, weights);
    kernels.add_weighted(values, has_infinite_[i] ? words.data() : queries, weights, sums[i]);
  }
}

void SumColumns::write(std::span<const RowSums> sums, std::size_t row, std::span<double> channels) const {
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i] = result(channels_[i], sums, row);
}

double SumColumns::result(const Channel& channel, std::span<const RowSums> sums, std::size_t row) const {
  const auto sum = [&](std::size_t column) {
    return CompensatedSum{sums[column].high[row], sums[column].low[row]}.value();
  };
  if (reduce_ == Reduce::Count) return sum(channel.weights);
  const auto& [values, exponent] = std::isfinite(sum(channel.values.column)) ? channel.values : channel.large;
  if (reduce_ == Reduce::Sum) return std::ldexp(sum(values), exponent);
  const double weights = sum(channel.weights);
  if (weights == 0) return kNan;
  return std::ldexp(sum(values) / weights, exponent);
}

ReducerFactory sum_reducers(const NodeTree& tree, SumColumns columns) {
  std::vector<std::vector<double>> of_nodes(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) of_nodes[i] = reduced_by_node(tree, columns.column(i), sum_of);
  return factory_of<SumReducer>(SumTables{std::move(columns), std::move(of_nodes)});
}

}  // namespace meshhood::inline v0_1
