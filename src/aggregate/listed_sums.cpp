// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/batch.h"

#include "aggregate/reducers.h"
#include "batch/position_sort.h"
#include "exact/index_access.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kFewestChannels = 17;  // at most 16 share one search over nodes
constexpr double kMostVertices = 400;        // with more in a mean row, the rounding errors would be too large
// A Gaussian has no sums over nodes, and its weights serve all channels either way. With fewer channels than these, and
// more vertices than these, a list takes longer.
constexpr std::size_t kManyChannels = 48;
constexpr double kFewVertices = 60;
constexpr std::size_t kRowsTogether = 4096;    // the lists of so many rows wait for the product
constexpr std::size_t kChannelsOfABlock = 32;  // so many values of each vertex of a row stay in the cache

/// Returns whether the numbers are far from overflow and underflow, so that they need no scaling.
bool is_moderate(const SignalView& signal) {
  constexpr double kLargestTerm = 0x1p+300;
  const auto is_fine = [](double value) { return !(std::abs(value) > kLargestTerm); };  // NaN is fine
  if (!signal.values.visit([&](auto values) { return std::all_of(values.begin(), values.end(), is_fine); })) {
    return false;
  }
  const auto is_fine_weight = [](double weight) {
    return weight == 0 || (weight > 1 / kLargestTerm && weight < kLargestTerm);
  };
  return std::all_of(signal.weights.begin(), signal.weights.end(), is_fine_weight);
}

/// Returns the mean size of the neighborhoods of some vertices, which depend on the index alone.
double mean_count(const Index& index, Metric metric, double radius, const Run& run) {
  constexpr std::size_t kSample = 64;
  const std::size_t vertices = index.vertex_count();
  std::vector<VertexId> sample(std::min(kSample, vertices));
  for (std::size_t i = 0; i < sample.size(); ++i) {
    sample[i] = IndexAccess::view(index).id(i * vertices / sample.size());
  }
  const BatchQuery query{.vertices = sample, .radius = radius, .metric = metric};
  const std::vector<std::uint64_t> sizes = counts(index, query, {.threads = run.threads});
  return static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})) /
         static_cast<double>(std::max<std::size_t>(sizes.size(), 1));
}

/// The sums of up to `kChannelsOfABlock` channels, and of the weights of their values.
struct Sums {
  std::array<double, kChannelsOfABlock> values{};
  std::array<double, kChannelsOfABlock> weights{};
};

/// Adds `count` values of each of a row's vertices. With `Omit`, a NaN is left out.
template <bool Omit, class Real>
void add(std::span<const VertexId> ids, const double* weights, const Real* values, std::size_t channels,
         std::size_t count, Sums& sums) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double weight = weights[i];
    const Real* const row = values + ids[i] * channels;
    const auto add_channel = [&](std::size_t c) {
      const auto value = static_cast<double>(row[c]);
      if constexpr (Omit) {
        sums.values[c] += std::isnan(value) ? 0.0 : weight * value;
        sums.weights[c] += std::isnan(value) ? 0.0 : weight;
      } else {
        sums.values[c] += weight * value;
      }
    };
    if (count == kChannelsOfABlock) {  // the compiler unrolls a loop of constant length
      for (std::size_t c = 0; c < kChannelsOfABlock; ++c) add_channel(c);
    } else {
      for (std::size_t c = 0; c < count; ++c) add_channel(c);
    }
  }
}

/// Holds some rows, near each other, as lists, and reduces them.
class ListedRows {
 public:
  ListedRows(const SignalView& signal, const AggregateQuery& query, double radius)
      : signal_(signal), query_(query), radius_(radius) {}

  /// Replaces distances by weights, and leaves out vertices whose own weight is 0.
  void set(Neighborhoods&& rows) {
    rows_ = std::move(rows);
    std::size_t kept = 0;
    std::size_t i = 0;
    for (std::size_t row = 0; row + 1 < rows_.offsets.size(); ++row) {
      for (const std::size_t end = rows_.offsets[row + 1]; i < end; ++i) {
        const VertexId id = rows_.ids[i];
        const double own = signal_.weights.empty() ? 1 : signal_.weights[id];
        if (own == 0) continue;
        rows_.ids[kept] = id;
        rows_.distances[kept++] = own * smoothing_weight(query_.kernel, rows_.distances[i], radius_);
      }
      rows_.offsets[row + 1] = kept;
    }
  }

  /// Writes the reductions of the channels of a row.
  void write(std::size_t row, double* out) const {
    const std::size_t begin = rows_.offsets[row];
    const std::span<const VertexId> ids = std::span(rows_.ids).subspan(begin, rows_.offsets[row + 1] - begin);
    const double* const weights = rows_.distances.data() + begin;
    const double all_weights = std::accumulate(weights, weights + ids.size(), 0.0);
    const bool omits = query_.missing == MissingValues::Omit;
    for (std::size_t first = 0; first < signal_.channels; first += kChannelsOfABlock) {
      const std::size_t count = std::min(kChannelsOfABlock, signal_.channels - first);
      Sums sums;
      signal_.values.visit([&](auto values) {
        const auto* const start = values.data() + first;
        omits ? add<true>(ids, weights, start, signal_.channels, count, sums)
              : add<false>(ids, weights, start, signal_.channels, count, sums);
      });
      for (std::size_t c = 0; c < count; ++c) {
        for (const Reduce reduce : query_.reduce) {
          *out++ = result(reduce, sums.values[c], omits ? sums.weights[c] : all_weights);
        }
      }
    }
  }

 private:
  [[nodiscard]] static double result(Reduce reduce, double sum, double weights) {
    if (reduce == Reduce::Mean) sum = weights > 0 ? sum / weights : kNan;
    return std::isnan(sum) ? kNan : sum;  // sign and payload of a NaN vary
  }

  const SignalView& signal_;
  const AggregateQuery& query_;
  double radius_;
  Neighborhoods rows_;
};

}  // namespace

bool is_better_listed(const Index& index, const SignalView& signal, const AggregateQuery& query, double radius,
                      const Run& run) {
  const bool has_kernel = query.kernel != SmoothingKernel::Box;
  constexpr double kSmallestRadius = 0x1p-450;  // squares of shorter distances underflow
  const bool is_slower = query.kernel == SmoothingKernel::Gaussian && signal.channels < kManyChannels;
  const double most = is_slower ? kFewVertices : kMostVertices;
  return has_kernel && radius > kSmallestRadius && signal.channels >= kFewestChannels &&
         mean_count(index, query.metric, radius, run) <= most && is_moderate(signal);
}

void sum_listed(const Index& index, const SignalView& signal, const AggregateQuery& query, double radius,
                std::span<double> result, const Run& run) {
  const IndexView& view = IndexAccess::view(index);
  const std::size_t count = query.vertices.count(index.vertex_count());
  TaskContext task(run.threads, run.progress, count);
  // Rows that are near each other follow each other, because they share values in the cache.
  const RawVector<std::size_t> rows =
      rows_by_position(count, [&](std::size_t row) { return view.slot[query.vertices[row]]; }, task);
  ListedRows listed(signal, query, radius);
  const std::size_t numbers = signal.channels * query.reduce.size();
  std::vector<VertexId> vertices;
  for (std::size_t begin = 0; begin < rows.size(); begin += kRowsTogether) {
    const std::span<const std::size_t> some =
        std::span(rows).subspan(begin, std::min(kRowsTogether, rows.size() - begin));
    Progress still_wanted;
    if (run.progress) {
      still_wanted = [&](std::size_t, std::size_t) { return run.progress(begin, rows.size()); };
    }
    vertices.clear();
    for (const std::size_t row : some) vertices.push_back(query.vertices[row]);
    listed.set(neighborhoods(index, {.vertices = vertices, .radius = radius, .metric = query.metric},
                             {.distances = true}, {.threads = run.threads, .progress = still_wanted}));
    constexpr std::size_t kGrain = 16;
    task.parallel_for(some.size(), kGrain, [&](unsigned thread, std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) listed.write(i, &result[some[i] * numbers]);
      task.advance(thread, end - first);
    });
  }
  task.finish();
}

}  // namespace meshhood::inline v0_1
