// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/frame.h"
#include "curvature/sure_leaves.h"
#include "curvature/symmetric.h"
#include "simd/moments.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// The power of two by which coordinates are multiplied before their powers are summed. It brings `extent`, a length in
/// the frame, to between 1/2 and 1; a length below 2^-1000 stays less than that, because the factor must be finite.
[[nodiscard]] inline double unit_factor(double extent, const Frame& frame) {
  if (!(extent > 0)) return frame.scale;
  constexpr int kLargestFactorExponent = 1000;
  return std::ldexp(1.0, std::min(std::ilogb(frame.scale) - std::ilogb(extent) - 1, kLargestFactorExponent));
}

/// The values from which the moments of a packet are computed, in index order.
struct MomentSource {
  const IndexView* index;                 // which is searched, with its walls
  const OrientedIndex* filter = nullptr;  // only vertices whose normal faces that of the query vertex, if set
  std::span<const double> weights = {};   // by vertex; 1 if empty
  Metric metric = Metric::Straight;       // of the neighborhoods, and of their radii
};

/// The mean of the points of a query and the axes of their covariance about it, in the unit of the moments.
struct PointDistribution {
  Point center;
  Eigen3 axes;
};
[[nodiscard]] PointDistribution distribution_of(const QueryMoments& moments, std::size_t query);

/// Of each query, the sums of the squares and fourth powers of distances.
struct MomentSizes {
  QueryRow second;
  QueryRow fourth;
};

/// The moments of the neighborhoods of up to 32 vertices of a leaf. What is added is the powers of vertices, and sums
/// of these over leaves: first the sure leaves for the radius of a query (see `SureLeaves`), which are summed once for
/// all queries; then, in index order, each leaf that the query has as a whole, and each vertex of the other leaves.
/// By paths and rings, no leaves are sure.
/// The coordinates are relative to the center of the leaf, and the sums are moved to each query vertex at the end. All
/// of this depends on index, leaf, vertex and radius alone, not on the other queries. Owns 45 kB of memory, and 8 bytes
/// for each leaf of the mesh.
class PacketMoments {
 public:
  /// Borrows what `source` names.
  PacketMoments(const MomentSource& source, Isa isa);

  /// Begins with query vertices of a leaf, named by their places in index order. `radii` are those of their closed
  /// balls; only `with_vertices` have a neighborhood. Returns those of `queries` that have the same unit, of which the
  /// moments will be: with the first, those of similar radii.
  QueryWord begin(LeafId leaf, std::span<const std::uint32_t> places, std::span<const double> radii, QueryWord queries,
                  QueryWord with_vertices);

  /// A leaf whose vertices all belong to the queries of `word`. Leaves ascend from call to call.
  void add(LeafId leaf, QueryWord word);

  /// The same for a leaf with a word for each vertex.
  void add(LeafId leaf, const QueryWord* words);

  /// The moments about the query vertices, in a unit that makes their coordinates about 1: `scale()` times those of
  /// the mesh, a power of two. Valid until the next `begin`.
  const QueryMoments& finish();

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const MomentKernels& kernels() const { return *kernels_; }

  /// The sizes of the moments before they were moved to the query vertices, or after, whichever are larger. The errors
  /// of the moments of degree 2 and 4 are of the order of epsilon times them.
  [[nodiscard]] double second_size(std::size_t query) const {
    return std::max(before_.second[query], after_.second[query]);
  }
  [[nodiscard]] double fourth_size(std::size_t query) const {
    return std::max(before_.fourth[query], after_.fourth[query]);
  }

  /// Whether the moments are accurate to 1e-13 of the sum of w |p|^(i + j + k). They are not where the vertices of the
  /// leaf lie much farther apart than those of the neighborhood, as in a leaf with vertices of large and small faces.
  [[nodiscard]] bool is_accurate(std::size_t query) const;

 private:
  friend struct ScratchAccess;  // defined by tests

  [[nodiscard]] double reach_of(double radius, double extent) const;
  QueryWord set_unit(LeafId leaf, std::span<const double> radii, QueryWord queries);
  void set_offsets(std::span<const std::uint32_t> places);
  void set_normals(LeafId leaf, std::span<const std::uint32_t> places);
  void set_axis(LeafId leaf);
  void add_sure_leaves(LeafId leaf, std::span<const double> radii);
  [[nodiscard]] bool faces_all(const Leaf& leaf) const;
  void add_terms_of(const Leaf& leaf, std::span<const QueryWord> words, QueryWord all);
  void add_terms();
  void set_points(const Leaf& leaf);

  static constexpr std::size_t kTerms = 64;

  MomentSource source_;
  const MomentKernels* kernels_;
  SureLeaves sure_;

  std::size_t size_ = 0;
  QueryWord active_ = 0;  // those that get sums
  Point center_{0, 0, 0};
  double scale_ = 1;
  QueryVectors offsets_;  // from the query vertices to the center
  FacingTest facing_;

  // Terms that are not added yet. Added together, they cost less.
  std::size_t term_count_ = 0;
  std::array<PaddedMoments, kTerms> terms_;
  std::array<QueryWord, kTerms + 15> words_{};
  MomentPoints points_;
  MomentsByQuery sums_;
  QueryMoments moments_;
  MomentSizes before_;  // about the center
  MomentSizes after_;   // about the query vertices
};

}  // namespace meshhood::inline v0_1
