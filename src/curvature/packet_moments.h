// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/frame.h"
#include "curvature/surface.h"
#include "curvature/symmetric.h"
#include "simd/moments.h"

namespace meshhood {

/// The power of two by which coordinates are multiplied before their powers are summed. It brings `extent`, a length in
/// the frame, to between 1/2 and 1; a length below 2^-1000 stays less than that, because the factor must be finite.
[[nodiscard]] inline double unit_factor(double extent, const Frame& frame) {
  if (!(extent > 0)) return frame.scale;
  constexpr int kLargestFactorExponent = 1000;
  return std::ldexp(1.0, std::min(std::ilogb(frame.scale) - std::ilogb(extent) - 1, kLargestFactorExponent));
}

/// The values from which the moments of a packet are computed, in index order.
struct MomentSource {
  const IndexView* index;
  const SurfaceState* filter = nullptr;  // only vertices whose normal faces that of the query vertex, if set
  std::span<const double> weights = {};  // by vertex; 1 if empty
};

/// The mean of the points of a query and the axes of their covariance about it, in the unit of the moments.
struct PointDistribution {
  Point center;
  Eigen3 axes;
};
[[nodiscard]] PointDistribution distribution_of(const QueryMoments& moments, std::size_t query);

/// See `PacketMoments::sizes`.
struct MomentSizes {
  double second;
  double fourth;
};

/// The moments of the neighborhoods of up to 32 vertices that lie close together. A vertex that counts for all queries
/// is added once, about a common center; the sums are moved to each query vertex at the end. Owns 30 kB of memory.
class PacketMoments {
 public:
  /// Borrows what `source` names.
  PacketMoments(const MomentSource& source, Isa isa);

  /// Begins with the query vertices at these positions in index order. No vertex that will be added is farther than
  /// `reach` from its query vertex. Only `queries` have vertices.
  void begin(std::span<const std::uint32_t> places, double reach, QueryWord queries = ~QueryWord{0});

  /// The vertices `first .. first + size - 1` in index order belong to the queries of `word`.
  void add(std::size_t first, std::size_t size, QueryWord word);

  /// The same with a word for each vertex; `size` <= 32.
  void add(std::size_t first, std::size_t size, std::span<const QueryWord, kPacketCapacity> words);

  /// The moments about the query vertices, in a unit that makes their coordinates about 1: `scale()` times those of
  /// the mesh, a power of two. Valid until the next `begin`.
  const QueryMoments& finish();

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const MomentKernels& kernels() const { return *kernels_; }

  /// Sums of the squares and fourth powers of distances, before the moments were moved to the query vertex or after,
  /// whichever are larger. The errors of the moments of these degrees are of the order of epsilon times them.
  [[nodiscard]] const MomentSizes& sizes(std::size_t query) const { return sizes_[query]; }

  /// Whether the moments are accurate to 1e-13 of the sum of w |p|^(i + j + k). They are not where the query vertices
  /// lie much farther apart than the vertices of the neighborhood, as in a leaf with vertices of large and small faces.
  [[nodiscard]] bool is_accurate(std::size_t query) const { return is_accurate_[query]; }

 private:
  friend struct ScratchAccess;  // defined by tests

  void set_center(double reach);
  void set_normals(std::span<const std::uint32_t> places);
  void set_axis();
  template <class WordOf>
  void add_leaves(std::size_t first, std::size_t size, const WordOf& word_of);
  void add_common();
  void add_some();
  void set_points(std::span<const std::uint32_t> places);
  [[nodiscard]] bool is_accurate(std::size_t query, const MomentSizes& before, const MomentSizes& after) const;

  MomentSource source_;
  const MomentKernels* kernels_;

  std::size_t size_ = 0;
  QueryWord active_ = 0;  // without the queries that have no normal, if there is a filter
  Point center_{0, 0, 0};
  double scale_ = 1;
  QueryVectors offsets_;  // from the query vertices to the center
  FacingTest facing_;

  // Vertices that are not added yet. Added together, they fill the vectors of the kernels.
  VertexList waiting_common_;  // for all queries
  VertexList waiting_some_;
  MomentPoints points_;
  PartialMoments common_;
  MomentsByQuery some_;
  QueryMoments moments_;
  PerLane<MomentSizes> sizes_{};
  PerLane<bool> is_accurate_{};
};

}  // namespace meshhood
