// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/frame.h"
#include "base/prefetch.h"
#include "exact/layout.h"
#include "shared/distance.h"
#include "surface/face_tree.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {

/// A ray, by the method of S. Woop, C. Benthin, I. Wald ("Watertight ray/triangle intersection", Journal of Computer
/// Graphics Techniques 2, 2013): space is sheared along the main axis of the ray, so that the ray becomes this axis,
/// and seen along it. A corner is seen at the same place whatever its triangle, and on which side of a line between two
/// of them the ray passes is decided exactly. So it cannot slip through where triangles meet.
class Ray {
 public:
  /// `direction` is finite and not 0.
  Ray(const Point& origin, const Point& direction, const Frame& frame);

  /// Returns where it meets a triangle: at a corner or on a side, the weights of the others are exactly 0, and the
  /// distance is that of each triangle there, bit for bit. None for a triangle seen from its side or without an area.
  [[nodiscard]] std::optional<TrianglePoint> meet(const std::array<Point, 3>& corners) const;

  /// Return origin and direction in the frame; the largest component of `direction` is 1 or -1.
  [[nodiscard]] const Point& origin() const { return in_frame_; }
  [[nodiscard]] const Point& direction() const { return direction_; }

  /// Returns how many times `direction` leads to a distance, in the frame.
  [[nodiscard]] double way_to(double distance) const { return distance * frame_scale_ / length_; }

 private:
  using Axes = std::array<double Point::*, 3>;

  /// Returns the coordinates to the right, up, and along the main axis of the direction.
  [[nodiscard]] Point turn(const Point& p) const { return {p.*axes_[0], p.*axes_[1], p.*axes_[2]}; }

  /// Returns a point relative to the origin of the ray; z is the way along it.
  [[nodiscard]] Point see(const Point& p) const;

  Point in_frame_;
  Point direction_;
  double length_;  // of `direction_`
  double frame_scale_;
  double scale_;  // makes what is seen about 1, from far away as well
  Axes axes_;
  Point turned_origin_;
  Point turned_direction_;
};

/// Finds the first of the triangles that a ray meets and for which `counts(i, at)`.
template <class Counts>
class FirstHitSearch {
 public:
  /// `index` and `tree` must outlive it. `direction` is finite and not 0.
  FirstHitSearch(const IndexView& index, const FaceTree& tree, const Point& origin, const Point& direction,
                 Counts counts)
      : index_(&index),
        tree_(&tree),
        ray_(origin, direction, index.frame),
        counts_(std::move(counts)),
        line_(ray_.origin(), ray_.direction(), reach_),
        walk_(tree.boxes(), line_) {}
  FirstHitSearch(const FirstHitSearch&) = delete;
  FirstHitSearch& operator=(const FirstHitSearch&) = delete;

  /// Takes one step, at whose end memory is fetched for the next one. Returns false at the end.
  bool advance() {
    return walk_.advance([&](std::size_t i) { meet(i); }, [&](std::size_t i) { prefetch(&tree_->triangles()[i]); });
  }

  /// Returns the first one so far; at an infinite distance if none was met.
  [[nodiscard]] const TriangleHit& first() const { return first_; }

 private:
  struct Reach {
    const FirstHitSearch* search;
    double operator()() const { return search->way_; }
  };

  void meet(std::size_t i) {
    const std::optional<TrianglePoint> at = ray_.meet(corners_of(*index_, tree_->triangles()[i].corners));
    if (!at || !precedes({i, *at}, first_, tree_->triangles()) || !counts_(i, *at)) return;
    first_ = {i, *at};
    way_ = ray_.way_to(first_.at.distance);
  }

  const IndexView* index_;
  const FaceTree* tree_;
  Ray ray_;
  Counts counts_;
  TriangleHit first_;
  double way_ = kInfinity;  // to it
  Reach reach_{this};
  BoxTree::Line<Reach> line_;
  BoxTree::Walk<BoxTree::Line<Reach>> walk_;
};

/// Does the same in one call.
template <class Counts>
[[nodiscard]] TriangleHit find_first_hit(const IndexView& index, const FaceTree& tree, const Point& origin,
                                         const Point& direction, Counts&& counts) {
  FirstHitSearch search(index, tree, origin, direction, std::forward<Counts>(counts));
  while (search.advance()) {
  }
  return search.first();
}

}  // namespace meshhood::inline v0_1
