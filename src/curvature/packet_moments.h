// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/moments.h"
#include "meshhood/search.h"

#include "base/epoch_array.h"
#include "base/frame.h"
#include "base/vector.h"
#include "batch/packets.h"
#include "curvature/symmetric.h"
#include "exact/layout.h"
#include "simd/ball.h"
#include "simd/leaf.h"
#include "simd/moments.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// Returns the power of two by which coordinates are multiplied before their powers are summed. It brings `extent`, a
/// length in the frame, to between 1/2 and 1; a length below 2^-1000 stays less than that, because the factor must be
/// finite.
[[nodiscard]] inline double unit_factor(double extent, const Frame& frame) {
  if (!(extent > 0)) return frame.scale;
  constexpr int kLargestFactorExponent = 1000;
  return std::ldexp(1.0, std::min(std::ilogb(frame.scale) - std::ilogb(extent) - 1, kLargestFactorExponent));
}

/// Finds the places in index order of the vertices of the neighborhood of the one at `place`. They ascend.
inline void find_places(Searcher& searcher, const IndexView& index, std::uint32_t place, double radius,
                        std::vector<std::uint32_t>& found) {
  found.clear();
  for (const VertexRange& range : searcher.ranges(index.id(place), radius)) {
    for (VertexId i = range.begin; i < range.end; ++i) found.push_back(i);
  }
}

/// Returns how far these places reach from a point along an axis, in the frame.
[[nodiscard]] inline double extent_of(const IndexView& index, std::span<const std::uint32_t> places,
                                      const Point& center) {
  double extent = 0;
  for (const std::uint32_t i : places) {
    extent = std::max(extent, largest_component(index.frame.scale * (index.position(i) - center)));
  }
  return extent;
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

/// Finds the *sure leaves* of a leaf for a radius: leaves that are whole in the neighborhoods of all its vertices, as
/// spheres and links tell. They depend on index, leaf and radius alone, and those of a smaller radius are a prefix of
/// those of a larger one. So a sum over them is made once for queries of any radii.
///
/// Let the leaf have the sphere (c, s), and another leaf the sphere (d, t). Each vertex of the one is at most
/// s + |c - d| + t, the *reach* of the other, from each vertex of the latter. A sure leaf is connected, has a reach of
/// at most the radius, and is the leaf itself or linked with a sure leaf. So all its vertices are in the ball, and
/// connected with the query vertex by leaves in the ball. Leaves with walls are not connected; one with ignored
/// vertices is not whole, and is left out, too.
class SureLeaves {
 public:
  /// Borrows the index.
  explicit SureLeaves(const IndexView& index) : index_(&index), queries_(index.leaf_count()) {}

  /// Begins with a leaf, for growing radii.
  void begin(LeafId leaf);

  /// Returns the next sure leaf for this radius; none if there are no more. The order is that of Prim's algorithm: of
  /// the leaves that are linked with those before, the one of least reach. It does not depend on the radii.
  [[nodiscard]] std::optional<LeafId> next(const TreeBounds& radius);

  /// Set and return the queries whose sum has a leaf already. The caller sets them for one that `next` returned; at
  /// first there are none.
  void set_queries(LeafId leaf, QueryWord queries) { queries_[leaf] = queries; }
  [[nodiscard]] QueryWord queries(LeafId leaf) const { return queries_.is_known(leaf) ? queries_[leaf] : 0; }

 private:
  struct Entry {
    double reach;  // in the frame
    LeafId leaf;
  };

  static bool is_later(const Entry& a, const Entry& b) {
    return a.reach != b.reach ? a.reach > b.reach : a.leaf > b.leaf;
  }

  void meet(LeafId leaf);

  const IndexView* index_;
  FrameSphere center_{};
  std::vector<Entry> frontier_;    // a heap
  EpochArray<QueryWord> queries_;  // known of the leaves that were met
};

inline void SureLeaves::begin(LeafId leaf) {
  queries_.forget();
  frontier_.clear();
  center_ = index_->leaves[leaf].bounds;
  meet(leaf);
}

inline std::optional<LeafId> SureLeaves::next(const TreeBounds& radius) {
  if (frontier_.empty() || frontier_.front().reach > static_cast<double>(radius.inner)) return std::nullopt;
  std::pop_heap(frontier_.begin(), frontier_.end(), is_later);
  const LeafId leaf = frontier_.back().leaf;
  frontier_.pop_back();
  for (const Link& link : index_->links_of(leaf)) meet(link.leaf);
  return leaf;
}

/// Takes a leaf into the frontier, once.
inline void SureLeaves::meet(LeafId leaf) {
  if (queries_.is_known(leaf)) return;
  queries_.set(leaf, 0);
  const Leaf& other = index_->leaves[leaf];
  if (!other.connected || index_->ignored_lanes(leaf) != 0) return;
  const double distance = length(center_of(other.bounds) - center_of(center_));
  frontier_.push_back({(double{center_.radius} + distance) + double{other.bounds.radius}, leaf});
  std::push_heap(frontier_.begin(), frontier_.end(), is_later);
}

/// For each query, the sums of the squares and fourth powers of distances.
struct MomentSizes {
  QueryRow second;
  QueryRow fourth;
};

/// Sums the moments of the neighborhoods of up to 32 vertices of a leaf. It adds the powers of vertices, and sums of
/// these over leaves: first the sure leaves for the radius of a query (see `SureLeaves`), which are summed once for all
/// queries; then, in index order, each leaf that the query has as a whole, and each vertex of the other leaves. By
/// paths and rings, no leaves are sure. The coordinates are relative to the center of the leaf, and the sums are moved
/// to each query vertex at the end. All of this depends on index, leaf, vertex and radius alone, not on the other
/// queries. It owns 45 kB of memory, and 8 bytes for each leaf of the mesh.
class PacketMoments {
 public:
  /// Borrows what `source` names.
  PacketMoments(const MomentSource& source, Isa isa);

  /// Begins with query vertices of a leaf, named by their places in index order. `radii` are those of their closed
  /// balls; only `with_vertices` have a neighborhood. Returns those of `queries` that have the same unit, of which the
  /// moments will be: with the first, those of similar radii.
  QueryWord begin(LeafId leaf, std::span<const std::uint32_t> places, std::span<const double> radii, QueryWord queries,
                  QueryWord with_vertices);

  /// Adds a part of the answer. Leaves ascend from call to call.
  void add(const Piece& piece);

  /// Returns the moments about the query vertices, in a unit that makes their coordinates about 1: `scale()` times
  /// those of the mesh, a power of two. They are valid until the next `begin`.
  const QueryMoments& finish();

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const MomentKernels& kernels() const { return *kernels_; }

  /// Return the sizes of the moments before they were moved to the query vertices, or after, whichever are larger. The
  /// errors of the moments of degree 2 and 4 are of the order of epsilon times them.
  [[nodiscard]] double second_size(std::size_t query) const {
    return std::max(before_.second[query], after_.second[query]);
  }
  [[nodiscard]] double fourth_size(std::size_t query) const {
    return std::max(before_.fourth[query], after_.fourth[query]);
  }

  /// Returns whether the moments are accurate to 1e-13 of the sum of w |p|^(i + j + k). They are not where the vertices
  /// of the leaf lie much farther apart than those of the neighborhood, as in a leaf with vertices of large and small
  /// faces.
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
  void add_leaf(LeafId leaf, const QueryWord* words);
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

// The visitors below sum the moments of packets, and compute results from them. Each is for one thread, and borrows its
// arguments.

/// The rows of a packet. Row i is query i of the moments.
struct MomentRows {
  std::span<const std::size_t> rows;      // their numbers in the query
  std::span<const std::uint32_t> places;  // their vertices in index order
  std::span<const double> radii;          // of their closed balls
  QueryWord queries;                      // those that have moments here; the others come in another call
};

/// Receives the moments of the neighborhoods of a packet about its query vertices, in the unit of `sums.scale()`.
using MomentVisitor =
    std::function<void(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments)>;

/// Calls `visit` with each packet, once for the rows of each unit.
///
/// The moments of a row depend on index, source, vertex and radius alone, bit for bit: see `PacketMoments`.
[[nodiscard]] PacketVisitor moment_visitor(const MomentSource& source, MomentVisitor visit);

/// Weights in index order, times a power of two. It brings the largest to where no sum overflows, and sums of weights
/// 2^1300 times smaller lose nothing.
struct MomentWeights {
  std::vector<double> values;
  int exponent = 0;

  /// Error{InvalidOption} names the argument `name`.
  MomentWeights(const IndexView& index, std::span<const double> given, std::string_view name = "weights");
};

[[nodiscard]] PacketVisitor component_visitor(const Index& index, Metric metric, const MomentWeights& weights,
                                              PrincipalComponents& out);

/// Makes memory for as many rows.
[[nodiscard]] PrincipalComponents make_components(std::size_t rows);

[[nodiscard]] PacketVisitor curvature_visitor(const OrientedIndex& surface, Metric metric,
                                              const CurvatureOptions& options, const CurvatureMemory& out);

/// Makes memory for as many rows.
[[nodiscard]] Curvatures make_curvatures(std::size_t rows);
[[nodiscard]] CurvatureMemory memory_of(Curvatures& curvatures);

}  // namespace meshhood::inline v0_1
