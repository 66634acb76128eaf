// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/metric.h"
#include "meshhood/run.h"

/// Computes sums, means and other aggregates of values over neighborhoods, without lists of ids.
///
///     const std::vector<double> smooth = meshhood::aggregate(
///         index, {.values = thickness},
///         {.radius = meshhood::smoothing_radius(6.0), .kernel = meshhood::SmoothingKernel::Gaussian});
///
/// The formulas are in docs/aggregate.md.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// How the values of a neighborhood are combined.
enum class Reduce : std::uint8_t {
  Sum,                ///< sum of w x
  Mean,               ///< sum of w x / sum of w; NaN if the sum of the weights is 0
  Minimum,            ///< ignores the weights
  Maximum,            ///< ignores the weights
  Variance,           ///< of the population: sum of w (x - mean)^2 / sum of w; see `AggregateQuery::ddof`
  StandardDeviation,  ///< the square root of the variance
  Count,              ///< the number of values; ignores the weights
  Median,             ///< the quantile 0.5: of an even number of values, the mean of the two in the middle
  Quantile,           ///< ignores the weights, as the median; see `AggregateQuery::quantile`
};

/// How the weight of a vertex falls with its distance d from `v`, for `Reduce::Sum` and `Reduce::Mean`. Distances are
/// those of the metric, as is the radius r; nothing beyond the neighborhood is used. All but `Box` are
/// Error{InvalidOption} with another reduction.
enum class SmoothingKernel : std::uint8_t {
  Box,           ///< 1
  Epanechnikov,  ///< 1 - (d/r)^2
  Biweight,      ///< (1 - (d/r)^2)^2
  Gaussian,      ///< 1000^-(d/r)^2, which is 1/1000 at the radius: see `smoothing_radius`
};

/// The meaning of NaN in the values.
enum class MissingValues : std::uint8_t {
  Propagate,  ///< a neighborhood with a NaN gives NaN; only its count is a number, that of all vertices
  Omit,       ///< NaN marks a missing value, which is left out; a neighborhood without values gives NaN, its sum
              ///< and its count 0
};

/// The meaning of several radii. Both are the same with `Metric::Path` and `Metric::Space`.
enum class Nesting : std::uint8_t {
  Own,    ///< each radius has a neighborhood of its own
  Patch,  ///< the neighborhood of the largest radius, and of it the vertices within each smaller radius, whether
          ///< connected inside the smaller ball or not
};

/// Borrows a list of float or double. A temporary container is rejected by the compiler.
class ValuesView {
 public:
  ValuesView() = default;

  template <BorrowedReals Range>
  ValuesView(Range&& values) : values_(std::span<const detail::Element<Range>>(values)) {}

  /// Calls `f` with the span behind this view and returns its result.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), values_);
  }

  [[nodiscard]] std::size_t size() const {
    return visit([](auto values) { return values.size(); });
  }

  [[nodiscard]] double operator[](std::size_t i) const {
    return visit([i](auto values) { return static_cast<double>(values[i]); });
  }

 private:
  std::variant<std::span<const double>, std::span<const float>> values_;
};

/// Numbers at the vertices, and weights; borrowed for the call.
struct SignalView {
  /// #V by channels, vertex after vertex. Any number is allowed: a float counts as the double of its value, and NaN as
  /// `MissingValues` says.
  ValuesView values;

  /// The number of values per vertex, at least 1. Each channel is aggregated by itself.
  std::size_t channels = 1;

  /// #V numbers, finite and >= 0; if empty, each weight is 1. Sums, means and variances leave out a vertex of weight 0,
  /// whatever its value; minimum, maximum and count ignore the weights. See `vertex_areas`.
  Borrowed<double> weights = {};
};

/// Which neighborhoods are aggregated, as a `BatchQuery` says, and how. The lists are copied when the call begins.
struct AggregateQuery {
  BatchVertices vertices = {};

  /// Required: one for all rows, one for each row, or scales. A vertex at exactly the radius is inside.
  BatchRadius radius = {};

  Metric metric = Metric::Straight;
  std::vector<Reduce> reduce = {Reduce::Mean};  ///< at least one. All share one search
  SmoothingKernel kernel = SmoothingKernel::Box;
  MissingValues missing = MissingValues::Propagate;
  Nesting nesting = Nesting::Own;

  /// The variance divides by the number of values minus `ddof`: 0, or 1 if there are no weights. With 1, the variance
  /// of a single value is NaN.
  unsigned ddof = 0;

  /// In [0, 1], for `Reduce::Quantile`: of n values in ascending order, the one numbered `quantile (n - 1)` from 0;
  /// between two values, it is interpolated linearly.
  double quantile = 0.5;
};

/// Returns the size of the result: #radii by #rows by channels by #reductions, radius after radius, and row after row.
/// There is one radius unless there are scales; radii and ids are not checked. Throws Error{TooLarge} if it exceeds the
/// address space or `run.max_bytes`, and Error{InvalidOption} if there are no channels or no reductions.
[[nodiscard]] std::size_t aggregate_size(const Index& index, const SignalView& signal, const AggregateQuery& query,
                                         const Run& run = {});

/// Aggregates the values over the neighborhood of each row by the metric, and writes all of `result`, which
/// has `aggregate_size` numbers. The neighborhood of a wall is empty: its sum and count are 0, all else is NaN.
///
/// Sums are exact to 1e-14 of the sum of the absolute terms, whatever the size of the neighborhood; with a smoothing
/// kernel to 1e-13 of the sum of |w x|, where w is the weight of the vertex itself (docs/aggregate.md). Each result
/// depends on index, values, vertex and radius alone, bit for bit: not on the other rows and reductions of the call,
/// earlier calls, the number of threads or the processor. Minimum, maximum and count are exact. Values are scaled by a
/// power of two before they are squared or added, so that only a result too large for a double overflows; large values
/// elsewhere have no effect. An infinite value gives an infinite result, or NaN beside one of the other sign; where
/// its weight is 0, it counts nothing. With a smoothing kernel, a call of more than 16 channels may sum in another way
/// than one of fewer, one with a list of radii or patches of several scales, or one with values that are infinite or
/// above 2^300, so that the last bits differ.
///
/// With `Metric::Path`, each row takes the time of a search of a `Searcher` at the largest radius, and the first call
/// for an index computes the lengths of its edges. In space, each row is searched alone. Else the neighborhoods of one
/// leaf are found together, and vertices that they have in common are read once for all of them, most of them as
/// precomputed sums, but one by one for a Gaussian. Memory: for up to 16 channels at a time 9 bytes for each vertex and
/// channel, and as much for the weights; with a kernel 14 bytes instead; with a Gaussian 8, for up to 32 channels at a
/// time; twice as much for a channel with values above 2^300; for a quantile 12 more, and 4 a vertex for each thread;
/// each for every reduction. Added are the time of `counts`, 8 to 16 bytes a row of at most 2^22 rows at a time, and
/// for each thread a searcher, 4 bytes for each leaf of the mesh and 1 kB for each entry of a group (docs/joint.md). A
/// quantile sorts the values of the mesh, once a call.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, TooLarge, Cancelled}, naming row, radius or vertex. The
/// contents of `result` are then unspecified.
void aggregate(const Index& index, const SignalView& signal, const AggregateQuery& query, std::span<double> result,
               const Run& run = {});

/// Does the same, and returns the result.
[[nodiscard]] std::vector<double> aggregate(const Index& index, const SignalView& signal, const AggregateQuery& query,
                                            const Run& run = {});

/// Returns the area that each vertex represents, #V: each face gives equal shares to its corners, a third of a
/// triangle. It is 0 for a vertex without a face, is in the square of the unit of the positions, and is infinite where
/// that overflows. The area of a polygon is the length of its vector area. Throws Error{InvalidMesh, TooLarge}. Takes
/// O(#corners).
[[nodiscard]] std::vector<double> vertex_areas(const MeshView& mesh);

/// Returns the radius of the `SmoothingKernel::Gaussian` of this full width at half maximum, in the same unit: 1.57843
/// fwhm, at which exp(-4 ln 2 (d/fwhm)^2) is 1/1000. Throws Error{InvalidRadius} unless `fwhm` is >= 0 or infinite.
[[nodiscard]] double smoothing_radius(double fwhm);

/// Returns the weight of a vertex at a distance, divided by that at distance 0; it is 0 beyond the radius. Its error is
/// at most 1e-14, and for a Gaussian 1e-14 of the weight. It has the same bits on every processor and with every C
/// library. `distance` and `radius` are >= 0, which is not checked; if one is NaN, the weight is 0.
[[nodiscard]] double smoothing_weight(SmoothingKernel kernel, double distance, double radius);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
