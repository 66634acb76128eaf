// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"
#include "meshhood/vertex.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A point in space, in the unit of the positions.
using SpacePoint = std::array<double, 3>;

/// Where a search starts: the center of its balls, and its seeds, the vertices from which it spreads. Seeds that are
/// given are borrowed, and must outlive the call.
class Start {
 public:
  /// Vertex `v` is the center and the only seed.
  template <std::convertible_to<Vertex> V>
  Start(const V& v) : vertex_(Vertex(v)) {}

  /// center  any point in space: finite, no coordinate beyond 2^500 in magnitude.
  /// seeds   in [0, #V), in any order; repeats are allowed. A seed outside a ball does not count for that ball.
  Start(const SpacePoint& center, Borrowed<VertexId> seeds) : center_(center), seeds_(seeds) {}

  /// Any point in space is the center, and the vertex nearest to it that is no wall the only seed: what a click or
  /// a tracked tool gives. Throws as `nearest`.
  [[nodiscard]] static Start nearest(const Index& index, const SpacePoint& center);

  /// Returns the vertex, if the start is a vertex; then `center` is empty.
  [[nodiscard]] VertexId vertex() const { return vertex_; }
  [[nodiscard]] const std::optional<SpacePoint>& center() const& { return center_; }
  [[nodiscard]] const std::optional<SpacePoint>& center() const&& = delete;

  /// Returns the seeds, which are valid as long as this object and the seeds that it was given.
  [[nodiscard]] std::span<const VertexId> seeds() const& { return seeds_ ? *seeds_ : std::span(&vertex_, 1); }
  [[nodiscard]] std::span<const VertexId> seeds() const&& = delete;

 private:
  VertexId vertex_ = 0;  // the only seed, unless `seeds_` are given
  std::optional<SpacePoint> center_;
  std::optional<std::span<const VertexId>> seeds_;
};

/// Returns the point of a face with the barycentric coordinates `weights`: the sum of each weight times its corner,
/// added in order. With the corners as seeds it is the `Start` at that point.
///
/// corners  vertices of the mesh.
/// weights  one for each corner, finite; their sum should be 1, which is not checked.
///
/// Throws Error{VertexOutOfRange, InvalidOption}. Takes O(#corners).
[[nodiscard]] SpacePoint point_on_face(const Index& index, std::span<const VertexId> corners,
                                       std::span<const double> weights);

/// A vertex and its distance from a point.
struct NearestVertex {
  VertexId vertex;
  double distance;
  friend bool operator==(const NearestVertex&, const NearestVertex&) = default;
};

/// Returns the vertex nearest to `point`, connected or not, ignored or not, but no wall; of several at the same
/// distance, the one with the smallest id.
///
/// Throws Error{InvalidOption} if a coordinate is not finite or beyond 2^500, and Error{VertexOutOfRange} if the mesh
/// has no such vertex. Takes O(log #V) on most surfaces. Allocates nothing. Any number of threads may call it.
[[nodiscard]] NearestVertex nearest(const Index& index, const SpacePoint& point);

/// Does the same for many points, in their order; faster than one by one, as near points are searched after each other.
/// Throws as the overload above, naming the row, and Error{Cancelled}. Needs 40 bytes a point, 16 of them the result.
[[nodiscard]] std::vector<NearestVertex> nearest(const Index& index, std::span<const SpacePoint> points,
                                                 const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
