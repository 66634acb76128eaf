// SPDX-License-Identifier: MIT
#include "meshhood/aggregate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "aggregate/node_tree.h"
#include "aggregate/packet_cuts.h"
#include "aggregate/reducers.h"
#include "aggregate/signal_block.h"
#include "batch/packets.h"
#include "batch/rows.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

// Channels that are aggregated together share the search and the weights; their tables and sums should stay in the
// cache. With a Gaussian, weights cost more and there are no tables.
constexpr std::size_t kChannelsTogether = 16;
constexpr std::size_t kChannelsOfAGaussian = 32;

void check_signal(const SignalView& signal, std::size_t vertices) {
  if (signal.channels == 0) raise(ErrorCode::InvalidOption, "channels is 0, expected at least 1");
  if (signal.values.size() / signal.channels != vertices || signal.values.size() % signal.channels != 0) {
    raise(ErrorCode::InvalidOption, std::to_string(signal.values.size()) + " values, expected " +
                                        std::to_string(signal.channels) + " for each of " + std::to_string(vertices) +
                                        " vertices");
  }
  if (!signal.weights.empty()) check_weights(signal.weights, vertices);
}

void check_reduction(const SignalView& signal, const AggregateQuery& query) {
  const auto has_kernels = [](Reduce reduce) { return reduce == Reduce::Sum || reduce == Reduce::Mean; };
  if (query.kernel != SmoothingKernel::Box && !std::ranges::all_of(query.reduce, has_kernels)) {
    raise(ErrorCode::InvalidOption, "a smoothing kernel is for sum and mean only");
  }
  if (!(query.quantile >= 0 && query.quantile <= 1)) {
    raise(ErrorCode::InvalidOption, "quantile is " + to_text(query.quantile) + ", expected 0 to 1");
  }
  if (query.ddof > 1) raise(ErrorCode::InvalidOption, "ddof is " + std::to_string(query.ddof) + ", expected 0 or 1");
  if (query.ddof == 1 && !signal.weights.empty()) {
    raise(ErrorCode::InvalidOption, "ddof is 1 and there are weights, expected ddof 0");
  }
}

/// Holds a checked copy of what the caller might change during the call.
class CheckedQuery {
 public:
  CheckedQuery(const Index& index, const SignalView& signal, const AggregateQuery& query)
      : query_(query), rows_(index.vertex_count()) {
    check_signal(signal, index.vertex_count());
    check_reduction(signal, query);
    if (const auto& list = query.vertices.list()) {
      vertices_.assign(list->begin(), list->end());
      rows_ = vertices_.size();
      query_.vertices = vertices_;
    }
    if (const auto& list = query.radius.list()) {
      radii_.assign(list->begin(), list->end());
      query_.radius = radii_;
    }
    passes_ = radius_of_passes(query_.radius);
    static_cast<void>(Rows({query_.vertices, passes_.front()}, index.vertex_count()));
  }
  CheckedQuery(const CheckedQuery&) = delete;
  CheckedQuery& operator=(const CheckedQuery&) = delete;
  ~CheckedQuery() = default;

  [[nodiscard]] const AggregateQuery& query() const { return query_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }

  /// Returns the radius of each pass over the rows.
  [[nodiscard]] std::span<const BatchRadius> passes() const { return passes_; }

 private:
  AggregateQuery query_;
  std::vector<VertexId> vertices_;
  std::vector<double> radii_;
  std::vector<BatchRadius> passes_;
  std::size_t rows_;
};

/// Returns some channels of the signal, as a reduction needs them.
SignalBlock make_block(const IndexView& index, SignalView signal, std::size_t first, std::size_t count, Reduce reduce,
                       MissingValues missing) {
  const bool compares =
      reduce == Reduce::Minimum || reduce == Reduce::Maximum || reduce == Reduce::Median || reduce == Reduce::Quantile;
  if (compares || reduce == Reduce::Count) signal.weights = {};
  // Comparing reductions handle NaN themselves: a 0 in place of a missing value would be compared with the others.
  return {index, signal, first, count, compares ? MissingValues::Propagate : missing, !compares};
}

ReducerFactory make_factory(const IndexView& index, const NodeTree& tree, SignalBlock block, Reduce reduce,
                            const AggregateQuery& query) {
  switch (reduce) {
    case Reduce::Minimum:
    case Reduce::Maximum: return minimum_reducers(tree, std::move(block), reduce == Reduce::Maximum, query.missing);
    case Reduce::Variance:
    case Reduce::StandardDeviation:
      return variance_reducers(tree, std::move(block), {reduce == Reduce::StandardDeviation, query.ddof});
    case Reduce::Median: return quantile_reducers(tree, std::move(block), 0.5, query.missing);
    case Reduce::Quantile: return quantile_reducers(tree, std::move(block), query.quantile, query.missing);
    case Reduce::Sum:
    case Reduce::Mean:
    case Reduce::Count: break;
  }
  SumColumns columns(std::move(block), reduce);
  if (query.kernel == SmoothingKernel::Box) return sum_reducers(tree, std::move(columns));
  if (is_along_edges(query.metric) || query.kernel == SmoothingKernel::Gaussian) {
    return weighted_reducers(index, std::move(columns), query.kernel);
  }
  return kernel_sum_reducers(index, tree, std::move(columns), query.kernel == SmoothingKernel::Biweight);
}

/// Runs several reductions of the same packets. The numbers of a channel are side by side.
class Reducers final : public PacketReducer {
 public:
  explicit Reducers(const std::vector<ReducerFactory>& factories) {
    for (const ReducerFactory& make_reducer : factories) all_.push_back(make_reducer());
  }

  void begin(const PacketAnswer& packet) override {
    for (const auto& reducer : all_) reducer->begin(packet);
  }

  /// All agree, because the answer follows from metric and kernel.
  [[nodiscard]] bool takes_nodes() const override { return all_.front()->takes_nodes(); }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (const auto& reducer : all_) reducer->add_nodes(nodes, queries);
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    for (const auto& reducer : all_) reducer->add_leaf(vertices, queries);
  }

  void write(std::size_t row, std::span<double> numbers) override {
    std::array<double, kChannelsOfAGaussian> channels;
    const std::size_t count = numbers.size() / all_.size();
    for (std::size_t k = 0; k < all_.size(); ++k) {
      all_[k]->write(row, std::span(channels).first(count));
      for (std::size_t i = 0; i < count; ++i) numbers[i * all_.size() + k] = channels[i];
    }
  }

 private:
  std::vector<std::unique_ptr<PacketReducer>> all_;
};

/// The destination of the results of one radius and some channels.
struct Destination {
  double* first;       // of the radius and the first of the channels
  std::size_t stride;  // from row to row: all channels and reductions
  std::size_t count;   // of the numbers of a row

  void write(const PacketAnswer& packet, PacketReducer& reducer) const {
    for (std::size_t i = 0; i < packet.rows.size(); ++i) {
      const std::span<double> channels(first + packet.rows[i] * stride, count);
      reducer.write(i, channels);
      for (double& value : channels) {
        if (std::isnan(value)) value = kNan;  // sign and payload of a NaN vary
      }
    }
  }
};

/// Runs a whole aggregate: blocks of channels, and passes over the rows.
class Aggregation {
 public:
  Aggregation(const Index& index, const SignalView& signal, const CheckedQuery& checked, std::span<double> result,
              const Run& run)
      : index_(index),
        view_(IndexAccess::view(index_)),
        tree_(view_),
        signal_(signal),
        query_(checked.query()),
        radii_(checked.passes()),
        has_patches_(query_.nesting == Nesting::Patch && radii_.size() > 1),
        rows_(checked.rows()),
        numbers_(signal.channels * query_.reduce.size()),
        result_(result),
        run_(run),
        together_(query_.kernel == SmoothingKernel::Gaussian ? kChannelsOfAGaussian : kChannelsTogether),
        blocks_((signal.channels + together_ - 1) / together_) {}

  void run() {
    std::vector<std::size_t> listed;
    for (std::size_t i = 0; i < radii_.size(); ++i) (is_listed(radii_[i]) ? listed : passes_).push_back(i);
    for (const std::size_t i : listed) reduce_listed(i);
    if (passes_.empty()) return;
    for (std::size_t first = 0; first < signal_.channels; first += together_) {
      const std::size_t count = std::min(together_, signal_.channels - first);
      const ReducerFactory make_reducer = all_reducers(first, count);
      if (shares_search()) {
        reduce_scales(make_reducer, passes_, first, count);
      } else {
        for (const std::size_t& i : passes_) reduce_scales(make_reducer, std::span(&i, 1), first, count);
      }
    }
  }

 private:
  [[nodiscard]] ReducerFactory all_reducers(std::size_t first, std::size_t count) const {
    std::vector<ReducerFactory> all;
    for (const Reduce reduce : query_.reduce) {
      SignalBlock block = make_block(view_, signal_, first, count, reduce, query_.missing);
      all.push_back(make_factory(view_, tree_, std::move(block), reduce, query_));
    }
    return factory_of<Reducers>(std::move(all));
  }

  [[nodiscard]] bool is_listed(const BatchRadius& radius) const {
    return !has_patches_ && !radius.list() && is_better_listed(index_, signal_, query_, radius.common(), run_);
  }

  void reduce_listed(std::size_t radius) {
    const std::size_t size = rows_ * numbers_;
    sum_listed(index_, signal_, query_, radii_[radius].common(), result_.subspan(radius * size, size),
               next_pass(blocks_));
  }

  /// Reduces what one search finds. If several scales share it, the answer of each is cut from that of the largest.
  void reduce_scales(const ReducerFactory& make_reducer, std::span<const std::size_t> scales, std::size_t first,
                     std::size_t count) {
    struct Cut {
      std::optional<PatchCutter> cutter;
      std::unique_ptr<PacketReducer> reducer;
      Destination to;
    };
    const auto radius_of = [&](std::size_t scale) { return radii_[scale].common(); };
    const std::size_t largest = *std::ranges::max_element(scales, {}, radius_of);
    for_each_packet(
        index_, {.vertices = query_.vertices, .radius = radii_[largest], .metric = query_.metric},
        [&](unsigned /*thread*/) -> PacketVisitor {
          const auto cuts = std::make_shared<std::vector<Cut>>();
          for (const std::size_t i : scales) {
            cuts->push_back({{}, make_reducer(), destination(i, first, count)});
            if (shares_search()) cuts->back().cutter.emplace(view_, tree_, radius_of(i));
          }
          const auto nodes = std::make_shared<MaximalNodes>(tree_);
          return [nodes, cuts](const PacketAnswer& packet) {
            for (Cut& cut : *cuts) {
              nodes->reduce(cut.cutter ? cut.cutter->cut(packet) : packet, *cut.reducer);
              cut.to.write(packet, *cut.reducer);
            }
          };
        },
        next_pass(), packet_form());
  }

  /// Returns whether one search serves all scales. By rings, each has its own: their rows have lengths only one by one.
  [[nodiscard]] bool shares_search() const {
    return query_.metric == Metric::Path ? passes_.size() > 1
                                         : query_.metric == Metric::Straight && has_patches_ && !passes_.empty();
  }

  [[nodiscard]] Destination destination(std::size_t radius, std::size_t first, std::size_t count) const {
    const std::size_t reductions = query_.reduce.size();
    return {result_.data() + radius * rows_ * numbers_ + first * reductions, numbers_, count * reductions};
  }

  [[nodiscard]] PacketForm packet_form() const {
    const bool has_weights = query_.kernel != SmoothingKernel::Box;
    if (is_along_edges(query_.metric) && (has_weights || shares_search())) return PacketForm::WithLengths;
    // Box reducers get nodes in index order from pieces in any order, so that bits do not depend on the packet.
    return has_weights ? PacketForm::InOrder : PacketForm::AsFound;
  }

  /// Begins a pass that reduces `blocks` blocks of channels.
  Run next_pass(std::size_t blocks = 1) {
    Run pass{.threads = run_.threads};
    const std::size_t passes = blocks_ * (shares_search() ? radii_.size() - passes_.size() + 1 : radii_.size());
    if (run_.progress) {
      pass.progress = [this, passes, blocks, before = passes_begun_ * rows_](std::size_t done, std::size_t /*total*/) {
        return run_.progress(before + blocks * done, passes * rows_);
      };
    }
    passes_begun_ += blocks;
    return pass;
  }

  const Index& index_;
  const IndexView& view_;
  NodeTree tree_;
  SignalView signal_;
  const AggregateQuery& query_;
  std::span<const BatchRadius> radii_;  // of the passes
  std::vector<std::size_t> passes_;     // those whose rows are not listed
  bool has_patches_;                    // whether the neighborhoods of smaller radii are cut from those of the largest
  std::size_t rows_;
  std::size_t numbers_;  // of a row
  std::span<double> result_;
  const Run& run_;
  std::size_t together_;
  std::size_t blocks_;
  std::size_t passes_begun_ = 0;
};

bool overlap(std::span<const std::byte> a, std::span<const std::byte> b) {
  return std::less()(a.data(), b.data() + b.size()) && std::less()(b.data(), a.data() + a.size());
}

/// Copies the signal into `values` and `weights` where the result lies in its memory, because a part of the result is
/// written before all is read.
SignalView unchanged(const SignalView& signal, std::span<const double> result, std::vector<double>& values,
                     std::vector<double>& weights) {
  SignalView kept = signal;
  signal.values.visit([&](auto given) {
    if (!overlap(std::as_bytes(given), std::as_bytes(result))) return;
    values.assign(given.begin(), given.end());
    kept.values = values;
  });
  if (overlap(std::as_bytes(signal.weights), std::as_bytes(result))) {
    weights.assign(signal.weights.begin(), signal.weights.end());
    kept.weights = weights;
  }
  return kept;
}

/// Returns the product, if its doubles fit into `max_bytes`.
std::size_t checked_size(std::size_t radii, std::size_t rows, std::size_t channels, std::size_t reductions,
                         std::uint64_t max_bytes) {
  const std::uint64_t bytes = std::min<std::uint64_t>(max_bytes, std::numeric_limits<std::ptrdiff_t>::max());
  const std::uint64_t most = bytes / sizeof(double);
  const bool fits = rows == 0 || (channels <= most / rows && reductions <= most / rows / channels &&
                                  radii <= most / rows / channels / reductions);
  if (!fits) {
    raise(ErrorCode::TooLarge,
          std::to_string(radii) + " radii of " + std::to_string(rows) + " rows of " + std::to_string(channels) +
              " channels by " + std::to_string(reductions) + " reductions are more than " + std::to_string(most) +
              " numbers" +
              (bytes == max_bytes ? ", as many as fit into max_bytes, " + std::to_string(bytes) : std::string()));
  }
  return radii * rows * channels * reductions;
}

}  // namespace

std::size_t aggregate_size(const Index& index, const SignalView& signal, const AggregateQuery& query, const Run& run) {
  if (signal.channels == 0) raise(ErrorCode::InvalidOption, "channels is 0, expected at least 1");
  if (query.reduce.empty()) raise(ErrorCode::InvalidOption, "there are no reductions, expected at least one");
  const auto& scales = query.radius.scales();
  return checked_size(scales ? scales->size() : 1, query.vertices.count(index.vertex_count()), signal.channels,
                      query.reduce.size(), run.max_bytes);
}

void aggregate(const Index& index, const SignalView& signal, const AggregateQuery& query, std::span<double> result,
               const Run& run) {
  const CheckedQuery checked(index, signal, query);
  const std::size_t size = aggregate_size(index, signal, checked.query(), run);
  if (result.size() != size) {
    raise(ErrorCode::InvalidOption,
          "the result has room for " + std::to_string(result.size()) + " numbers, expected " + std::to_string(size));
  }
  std::vector<double> values;
  std::vector<double> weights;
  Aggregation(index, unchanged(signal, result, values, weights), checked, result, run).run();
}

std::vector<double> aggregate(const Index& index, const SignalView& signal, const AggregateQuery& query,
                              const Run& run) {
  std::vector<double> result(aggregate_size(index, signal, query, run));
  aggregate(index, signal, query, result, run);
  return result;
}

}  // namespace meshhood::inline v0_1
