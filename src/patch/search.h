// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/patch.h"

#include "base/epoch_array.h"
#include "patch/clipped_triangle.h"
#include "patch/meshlets.h"
#include "patch/sums.h"
#include "shared/distance.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {

/// Searches triangles from a start, on one thread. A meshlet inside the ball is one step.
///
/// The triangles of a patch are joined by the corners and sides that they share, where these have a point in the ball.
/// A side has one if an end has; then its triangles share a corner in the ball. So a search steps from a triangle to
/// those at its corners in the ball, and over sides only where they dip into the ball between their ends.
class PatchSearch {
 public:
  /// Borrows the state.
  explicit PatchSearch(const PatchState& state);

  /// Finds the patch around `center` that has the triangles `starts`; with `measures`, its area and volume, too.
  void run(const Point& center, double radius, std::span<const TriangleId> starts, bool measures);

  // The functions below answer for the last run.

  /// Returns whether the patch has a triangle.
  [[nodiscard]] bool exists() const { return seen_count_ > 0; }

  /// Return the area in the unit of the mesh, and the volume in the frame, after a run with `measures`.
  [[nodiscard]] double area() const { return sums_.area(ball_); }
  [[nodiscard]] double volume() const { return exists() ? sums_.volume(ball_) : kNan; }

  /// Returns the nearest point of a triangle in the ball that the patch does not have.
  [[nodiscard]] SurfacePoint gap() const;

  /// Returns the patch as a mesh, without its area. `radius` is that of the run.
  [[nodiscard]] ClippedMesh clip(double radius, double tolerance) const;

  // As in `PacketPatches`, for query 0. A triangle is of the patch if it was seen, or its meshlet taken.
  [[nodiscard]] const PatchBall& ball(std::size_t /*query*/) const { return ball_; }
  [[nodiscard]] bool has(std::size_t /*query*/, TriangleId t) const { return seen_.has(t); }
  [[nodiscard]] QueryWord having(TriangleId t) const { return seen_.has(t) ? 1 : 0; }
  [[nodiscard]] QueryWord having_all(MeshletId m) const {
    return kinds_.is_known(m) && kinds_[m] == Kind::Taken ? 1 : 0;
  }

  /// Returns the triangles in the order of their faces.
  [[nodiscard]] std::vector<TriangleId> triangles() const;

 private:
  /// A whole meshlet lies inside the ball, and is not taken yet.
  enum class Kind : std::uint8_t { Partial, Whole, Taken };

  template <class Real>
  void spread(std::span<const Real> xyz);
  void visit(TriangleId t);
  [[nodiscard]] Kind kind_of(MeshletId meshlet);
  void take(MeshletId meshlet);
  void leave(MeshletId meshlet);
  void enter(std::uint32_t place);
  void add_whole(TriangleId t, const PatchTriangle& triangle);
  void add_cut(TriangleId t, const PatchTriangle& triangle);

  const PatchState* state_;
  EpochSet inside_;                    // places in the ball
  EpochSet seen_;                      // triangles
  EpochArray<Kind> kinds_;             // by meshlet
  std::vector<TriangleId> triangles_;  // seen, in this order; and room
  std::size_t seen_count_ = 0;
  std::vector<MeshletId> meshlets_;  // taken
  PatchSums sums_;
  PatchBall ball_{};
  bool measures_ = false;
};

}  // namespace meshhood::inline v0_1
