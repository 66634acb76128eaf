// SPDX-License-Identifier: MIT
// The thickness of a wall: along a ray, and by a ball that shrinks until no opposite face lies in it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "meshhood/surface.h"

#include "base/vector.h"
#include "batch/position_sort.h"
#include "batch/rows.h"
#include "shared/parallel.h"
#include "surface/face_tree.h"
#include "surface/face_triangles.h"
#include "surface/first_hit.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kVerticesOfTask = 256;

// The first ball reaches as far as the frame.
constexpr double kFirstRadius = 4;

/// What is opposite to a vertex.
class OppositeSide {
 public:
  OppositeSide(const OrientedIndex& oriented, const FaceTree& tree, std::size_t place)
      : index_(oriented.index),
        tree_(&tree),
        place_(static_cast<std::uint32_t>(place)),
        vertex_(oriented.position(place)),
        normal_(oriented.normal(place)),
        inward_(-1.0 * normal_) {}

  [[nodiscard]] double by_ray() const {
    return has_normal() ? way_to_first([](std::size_t) { return true; }) : kNan;
  }

  [[nodiscard]] double by_sphere(const NormalCones& cones) const {
    if (!has_normal()) return kNan;
    const double scale = index_->frame.scale;
    const double way = way_to_first([&](std::size_t i) { return opposes(i); });
    double radius = std::min(way / 2, kFirstRadius / scale);
    bool is_met = way < kInfinity;
    for (;;) {
      const TrianglePoint nearest = nearest_to(vertex_ + radius * inward_, radius, cones);
      const Point offset = scale * (nearest.point - vertex_);
      const double along = dot(inward_, offset);
      const bool is_inside = nearest.distance < radius && along > 0;
      const double smaller = is_inside ? dot(offset, offset) / (2 * along) / scale : radius;
      if (!(smaller > 0 && smaller < radius)) return is_met ? 2 * radius : kInfinity;
      radius = smaller;
      is_met = true;
    }
  }

 private:
  [[nodiscard]] bool has_normal() const { return !std::isnan(inward_.x); }

  [[nodiscard]] bool touches(std::size_t i) const {
    return std::ranges::count(tree_->triangles()[i].corners, place_) != 0;
  }

  [[nodiscard]] bool opposes(std::size_t i) const {
    return is_opposite(doubled_area(*index_, tree_->triangles()[i]), normal_);
  }

  /// Along the ray, to the first of the faces for which `is_counted(i)`.
  template <class IsCounted>
  [[nodiscard]] double way_to_first(IsCounted&& is_counted) const {
    const auto counts = [&](std::size_t i, const TrianglePoint& at) {
      return at.distance > 0 && !touches(i) && is_counted(i);
    };
    return find_first_hit(*index_, *tree_, vertex_, inward_, counts).at.distance;
  }

  /// The point of an opposite face nearest to the center of a ball; one that is not nearer than `radius` if there is
  /// none in the ball.
  [[nodiscard]] TrianglePoint nearest_to(const Point& center, double radius, const NormalCones& cones) const {
    const double scale = index_->frame.scale;
    TriangleHit nearest;
    tree_->boxes().search(
        index_->frame.to_frame(center), [&] { return reach_of(std::min(radius, nearest.at.distance) * scale, scale); },
        [&](std::size_t i) {
          if (touches(i) || !opposes(i)) return;
          const std::array<Point, 3> corners = corners_of(*index_, tree_->triangles()[i].corners);
          const TriangleHit found{i, nearest_in_triangle(center, corners, scale)};
          if (precedes(found, nearest, tree_->triangles())) nearest = found;
        },
        [&](std::size_t level, std::size_t group) { return cones.may_oppose(level, group, normal_); });
    return nearest.at;
  }

  const IndexView* index_;
  const FaceTree* tree_;
  std::uint32_t place_;
  Point vertex_;
  Point normal_;
  Point inward_;
};

}  // namespace

std::vector<double> thickness(const Surface& surface, const BatchVertices& vertices, ThicknessMethod method,
                              const Run& run) {
  const SurfaceState& state = SurfaceAccess::state(surface);
  const Rows rows({.vertices = vertices, .radius = 0}, state.index->vertex_count());
  TaskContext task(run.threads, run.progress, rows.size());
  const FaceTree& tree = state.tree(task);
  const NormalCones* const cones = method == ThicknessMethod::Sphere ? &state.cones(task) : nullptr;
  const OrientedIndex oriented = SurfaceAccess::oriented(surface, task);
  const RawVector<std::size_t> in_order =
      rows_by_position(rows.size(), [&](std::size_t row) { return state.index->slot[rows.vertex(row)]; }, task);
  std::vector<double> result(rows.size());
  task.parallel_for(rows.size(), kVerticesOfTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && task.should_continue(thread); ++i) {
      const std::size_t row = in_order[i];
      const OppositeSide side(oriented, tree, state.index->place(rows.vertex(row)));
      result[row] = cones == nullptr ? side.by_ray() : side.by_sphere(*cones);
      task.advance(thread, 1);
    }
  });
  task.finish();
  return result;
}

}  // namespace meshhood::inline v0_1
