// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "meshhood/surface.h"

#include "base/epoch_array.h"
#include "batch/packets.h"
#include "exact/joint/packet_answer.h"
#include "patch/clipped_triangle.h"
#include "patch/meshlets.h"
#include "patch/sums.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {

/// Finds the patches around the queries of a packet from their neighborhoods. Each thread needs its own.
///
/// A patch whose vertices are a neighborhood has the triangles with a corner in it, and those behind a side that dips
/// into the ball between its ends. So each triangle is looked at once for all queries, by the words of its corners: it
/// lies in the ball of the queries that have all three, and is cut by the sphere of those that have some. Cut triangles
/// are measured by vectors of queries.
///
/// What is added for a query, and in which order, depends on the query alone: meshlets and triangles ascend, and sums
/// over whole ones are apart from those over cut ones, which wait until a vector is full.
class PacketPatches {
 public:
  /// Takes packets of `state.searched`. Borrows the state.
  explicit PacketPatches(const PatchState& state);
  PacketPatches(const PacketPatches&) = delete;  // it points to rows of its own
  PacketPatches& operator=(const PacketPatches&) = delete;

  /// Returns the queries whose patches it has found. For the others, patch and neighborhood may differ, by a loose
  /// edge, a diagonal or what is behind a side that dips into the ball; or much is behind such sides; or the radius is
  /// almost 0. With `measures`, it also finds area and volume.
  QueryWord find(const PacketAnswer& packet, bool measures);

  // The functions below are for a query that was found.
  [[nodiscard]] const PatchBall& ball(std::size_t query) const { return balls_[query]; }
  [[nodiscard]] bool exists(std::size_t query) const { return (met_ >> query & 1U) != 0; }
  [[nodiscard]] double area(std::size_t query) const { return sums_[query].area(balls_[query]); }
  [[nodiscard]] double volume(std::size_t query) const {
    return exists(query) ? sums_[query].volume(balls_[query]) : kNan;
  }
  [[nodiscard]] bool has(std::size_t query, TriangleId t) const;
  /// Returns the nearest point of a triangle in the ball that the patch does not have. The first call finds all gaps.
  [[nodiscard]] const SurfacePoint& gap(std::size_t query);

  // These return the queries that have a corner of a triangle, or all of a meshlet.
  [[nodiscard]] QueryWord having(TriangleId t) const {
    const auto [a, b, c] = words_of(t);
    return a | b | c;
  }
  [[nodiscard]] QueryWord having_all(MeshletId meshlet) const { return all_.is_known(meshlet) ? all_[meshlet] : 0; }

 private:
  /// A side of a triangle that dips into the ball of a query.
  struct Dip {
    std::size_t query;
    TriangleId triangle;
    std::size_t side;
  };

  void clear();
  void set_balls(const PacketAnswer& packet);
  void set_words(const PacketAnswer& packet);
  void leave_loose();
  void touch(LeafId leaf);
  void add_meshlet(MeshletId meshlet);
  void add_triangle(TriangleId t, QueryWord queries);
  void meet_borders(TriangleId t, const std::array<QueryWord, 3>& words);
  void leave_at_diagonals(TriangleId t, const std::array<QueryWord, 3>& words);
  void add_cut(TriangleId t, const std::array<Point, 3>& corners, const std::array<QueryWord, 3>& words,
               QueryWord queries);
  void measure_cut();
  void add_clipped(TriangleId t, std::size_t query);
  void follow_dips();
  void follow(const Dip& dip);

  [[nodiscard]] bool is_found(std::size_t query) const { return (queries_ >> query & 1U) != 0; }
  void leave(std::size_t query) { queries_ &= ~(QueryWord{1} << query); }

  [[nodiscard]] std::array<QueryWord, 3> words_of(TriangleId t) const {
    const auto& [a, b, c] = state_->triangles.corners[t];
    return {words_[a], words_[b], words_[c]};
  }

  const PatchState* state_;
  const PatchKernels* kernels_;
  bool measures_ = false;
  QueryWord queries_ = 0;  // that are found
  std::array<PatchBall, kPacketCapacity> balls_{};
  PointPerLane<double> centers_{};  // of the balls
  std::vector<QueryWord> words_;    // by place: the queries that have the vertex
  std::vector<LeafId> leaves_;      // with words
  EpochArray<QueryWord> all_;       // by meshlet: the queries that have all of it
  std::vector<MeshletId> meshlets_;
  QueryWord met_ = 0;                   // that have a triangle
  std::vector<WholeTriangles> inside_;  // of a meshlet

  std::size_t cut_count_ = 0;  // waiting
  std::array<TriangleId, kPacketCapacity> cut_triangles_{};
  std::array<std::size_t, kPacketCapacity> cut_queries_{};
  std::array<std::array<LaneRow, 5>, kPacketCapacity> corner_rows_{};
  std::array<std::array<LaneRow, 2>, kPacketCapacity> ball_rows_{};  // by query
  CutTriangles cut_{};                                               // points to these rows
  ClippedTriangles clipped_{};

  std::vector<Dip> dips_;
  std::array<std::vector<TriangleId>, kPacketCapacity> extras_;  // without a corner in the ball
  WholeSums whole_{};
  std::array<PatchSums, kPacketCapacity> sums_;
  std::vector<SurfacePoint> gaps_;  // by query; none before they are asked for
};

/// The parts of patches that are asked for.
struct PatchParts {
  bool measures;
  bool gaps;
};

/// The patch of a row. What is not asked for stays as it is.
struct RowPatch {
  double radius;
  double area = kNan;
  double volume = kNan;  // in the frame
  SurfacePoint gap = {};
};

using RowPatchVisitor = std::function<void(std::size_t row, const RowPatch& patch)>;

/// Returns a visitor of packets of `state.searched`, for one thread, that calls `visit` with the patch of each row.
[[nodiscard]] PacketVisitor patch_visitor(const PatchState& state, PatchParts parts, RowPatchVisitor visit);

}  // namespace meshhood::inline v0_1
