// SPDX-License-Identifier: MIT
// Computes the moments of neighborhoods as callers get them, and principal components.
#include "meshhood/moments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meshhood/error.h"

#include "curvature/packet_moments.h"
#include "curvature/symmetric.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "shared/distance.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {
namespace {

/// Sums the moments of one neighborhood from the offsets of its vertices from the query vertex. It is slower than
/// `PacketMoments`, but accurate where the vertices of a leaf are much farther apart than the radius. Each thread needs
/// its own.
class DirectMoments {
 public:
  /// Borrows what `source` names, which has no filter. `index` is that of `source`.
  DirectMoments(const Index& index, const MomentSource& source) : searched_(&index), source_(source) {}

  /// Sums the neighborhood of the vertex at `place` in index order.
  void sum(std::uint32_t place, double radius) {
    if (!searcher_) searcher_.emplace(*searched_, source_.metric);
    find_places(*searcher_, *source_.index, place, radius, found_);
    const Point center = source_.index->position(place);
    set_units(center);
    PaddedMoments sums{};
    for (std::size_t begin = 0; begin < found_.size(); begin += kLeafCapacity) {
      const std::size_t size = std::min<std::size_t>(found_.size() - begin, kLeafCapacity);
      for (std::size_t k = 0; k < size; ++k) {
        const std::uint32_t i = found_[begin + k];
        points_.set(k, scale_ * (source_.index->position(i) - center),
                    source_.weights.empty() ? 1 : std::ldexp(source_.weights[i], weight_exponent_));
      }
      for (std::size_t k = size; k % 8 != 0; ++k) points_.set(k, {0, 0, 0}, 0);
      PaddedMoments some;
      moment_kernels(best_isa()).sum(points_, size, some);
      add(sums, some);
    }
    for (std::size_t m = 0; m < kMomentCount; ++m) moments_.at[m][0] = sums.at[m];
  }

  /// Returns the moments about the query vertex, as query 0, in the unit of `scale()`; valid until the next `sum`.
  [[nodiscard]] const QueryMoments& moments() const { return moments_; }
  [[nodiscard]] double scale() const { return scale_; }
  /// Weights were multiplied by 2 to this power.
  [[nodiscard]] int weight_exponent() const { return weight_exponent_; }

 private:
  /// Sets powers of two that bring the longest offset and the largest weight of the neighborhood to about 1.
  void set_units(const Point& center) {
    scale_ = unit_factor(extent_of(*source_.index, found_, center), source_.index->frame);
    double weight = 0;
    for (const std::uint32_t i : found_) weight = std::max(weight, source_.weights.empty() ? 1 : source_.weights[i]);
    weight_exponent_ = weight > 0 ? -std::ilogb(weight) : 0;
  }

  const Index* searched_;
  MomentSource source_;
  std::optional<Searcher> searcher_;
  std::vector<std::uint32_t> found_;
  double scale_ = 1;
  int weight_exponent_ = 0;
  MomentPoints points_{};
  QueryMoments moments_{};
};

/// The moments of one row about its query vertex, as `PacketMoments` has them.
struct RowMoments {
  const QueryMoments& sums;
  std::size_t query;
  double scale;         // of coordinates, a power of two
  int weight_exponent;  // of two, by which weights were multiplied

  /// Returns a moment in the unit of the caller.
  [[nodiscard]] double at(unsigned i, unsigned j, unsigned k) const {
    const int degree = static_cast<int>(i + j + k);
    return std::ldexp(sums.at[moment_index(i, j, k)][query], -degree * std::ilogb(scale) - weight_exponent);
  }
};

/// Calls `take(row, moments)` with each row.
template <class F>
PacketVisitor row_visitor(const Index& index, Metric metric, const MomentWeights& weights, F take) {
  const MomentSource source{.index = &IndexAccess::view(index), .weights = weights.values, .metric = metric};
  const auto direct = std::make_shared<DirectMoments>(index, source);
  return moment_visitor(source, [take, direct, exponent = weights.exponent](
                                    const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments) {
    for_each_query(packet.queries, [&](std::size_t q) {
      if (sums.is_accurate(q)) return take(packet.rows[q], RowMoments{moments, q, sums.scale(), exponent});
      direct->sum(packet.places[q], packet.radii[q]);
      take(packet.rows[q], RowMoments{direct->moments(), 0, direct->scale(), exponent + direct->weight_exponent()});
    });
  });
}

void write_row(PrincipalComponents& out, std::size_t row, const RowMoments& m) {
  out.weight[row] = m.at(0, 0, 0);
  const PointDistribution found = distribution_of(m.sums, m.query);
  const double to_caller = 1 / m.scale;
  set_row(out.center, row, to_caller * found.center);
  for (std::size_t i = 0; i < 3; ++i) {
    out.variances[3 * row + i] = std::max(found.axes.values[i], 0.0) * to_caller * to_caller;  // NaN stays NaN
    set_row(out.axes, 3 * row + i, with_sign(found.axes.vectors[i]));
  }
}

}  // namespace

MomentWeights::MomentWeights(const IndexView& index, std::span<const double> given, std::string_view name) {
  if (given.empty()) return;
  check_weights(given, index.vertex_count(), name);
  const double largest = *std::max_element(given.begin(), given.end());
  if (largest > 0) exponent = 500 - std::ilogb(largest);
  values.reserve(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) values.push_back(std::ldexp(given[index.id(i)], exponent));
}

PointDistribution distribution_of(const QueryMoments& moments, std::size_t query) {
  const double weight = moments.at[moment_index(0, 0, 0)][query];
  const auto mean = [&](std::size_t i, std::size_t j, std::size_t k) {
    return weight == 0 ? kNan : moments.at[moment_index(i, j, k)][query] / weight;
  };
  const Point center{mean(1, 0, 0), mean(0, 1, 0), mean(0, 0, 1)};
  const Symmetric3 covariance{mean(2, 0, 0) - center.x * center.x, mean(1, 1, 0) - center.x * center.y,
                              mean(1, 0, 1) - center.x * center.z, mean(0, 2, 0) - center.y * center.y,
                              mean(0, 1, 1) - center.y * center.z, mean(0, 0, 2) - center.z * center.z};
  return {center, eigen(covariance)};
}

std::vector<double> moments(const Index& index, const BatchQuery& query, const MomentOptions& options, const Run& run) {
  if (options.degree > kLargestMomentDegree) {
    raise(ErrorCode::InvalidOption,
          "degree is " + std::to_string(options.degree) + ", expected at most " + std::to_string(kLargestMomentDegree));
  }
  const std::size_t columns = moment_count(options.degree);
  std::vector<double> result(columns * query.result_rows(index.vertex_count(), columns));
  const MomentWeights weights(IndexAccess::view(index), options.weights);
  const auto write = [&](std::size_t row, const RowMoments& m) {
    for (unsigned i = 0; i <= options.degree; ++i) {
      for (unsigned j = 0; i + j <= options.degree; ++j) {
        for (unsigned k = 0; i + j + k <= options.degree; ++k) {
          result[columns * row + moment_column(i, j, k)] = m.at(i, j, k);
        }
      }
    }
  };
  for_each_packet(
      index, query, [&](unsigned /*thread*/) { return row_visitor(index, query.metric, weights, write); }, run);
  return result;
}

PacketVisitor component_visitor(const Index& index, Metric metric, const MomentWeights& weights,
                                PrincipalComponents& out) {
  return row_visitor(index, metric, weights, [&out](std::size_t row, const RowMoments& m) { write_row(out, row, m); });
}

PrincipalComponents make_components(std::size_t rows) {
  PrincipalComponents result;
  result.weight.resize(rows);
  result.center.resize(3 * rows);
  result.variances.resize(3 * rows);
  result.axes.resize(9 * rows);
  return result;
}

PrincipalComponents principal_components(const Index& index, const BatchQuery& query, const MomentOptions& options,
                                         const Run& run) {
  const MomentWeights weights(IndexAccess::view(index), options.weights);
  PrincipalComponents result = make_components(query.result_rows(index.vertex_count(), 9));  // of the axes
  for_each_packet(
      index, query, [&](unsigned /*thread*/) { return component_visitor(index, query.metric, weights, result); }, run);
  return result;
}

double surface_variation(double least, double middle, double largest) {
  if (largest == 0) return kNan;
  return least / largest / ((least / largest + middle / largest) + 1);
}

}  // namespace meshhood::inline v0_1
