// SPDX-License-Identifier: MIT
// Measures the thickness of a wall along a ray, and by a ball that shrinks until no opposite face lies in it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meshhood/surface.h"

#include "base/vector.h"
#include "batch/position_sort.h"
#include "batch/rows.h"
#include "shared/parallel.h"
#include "surface/face_points.h"
#include "surface/face_tree.h"
#include "surface/face_triangles.h"
#include "surface/first_hit.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kRowsOfTask = 256;

// What is not farther than this times a length is at the same place. The length is the largest of the coordinates of
// the spot, of those of the corners of the other face relative to it, and of the extent of its own face. That of the
// mesh would hide thin walls, because a vertex may be far away.
constexpr double kSamePlace = 0x1p-46;

/// A ball that touches a spot from inside, in the frame, and shrinks while a search goes through boxes. It stays inside
/// of what it was, so a box that it once did not meet is left out for good.
class TouchingBall {
 public:
  TouchingBall(const IndexView& index, const Point& at, const Point& inward, double radius)
      : index_(&index), at_(at), inward_(inward), radius_(radius), reach_(reach()), boxes_(center(), reach_) {}
  TouchingBall(const TouchingBall&) = delete;
  TouchingBall& operator=(const TouchingBall&) = delete;

  [[nodiscard]] double radius() const { return radius_; }

  void limit_to(double radius) {
    if (!(radius < radius_)) return;
    radius_ = radius;
    reach_ = reach();
    boxes_ = BoxTree::Ball<Reach>(center(), reach_);
  }

  /// Returns false only if no point of the triangle is in the ball.
  [[nodiscard]] bool may_contain(const std::array<std::uint32_t, 3>& corners) const {
    return !(compare_roughly(corners_in_frame(*index_, corners), center()).least > reach_.distance * reach_.distance);
  }

  unsigned compare(const BoxGroup& group, BoxGroup::Row& squares) const { return boxes_.compare(group, squares); }

  /// Distances of boxes from the centers of larger balls exclude none.
  [[nodiscard]] static float limit() { return std::numeric_limits<float>::infinity(); }

  void update() {}  // `limit_to` does so

 private:
  struct Reach {
    double distance;
    double operator()() const { return distance; }
  };

  [[nodiscard]] Point center() const { return at_ + radius_ * inward_; }

  [[nodiscard]] Reach reach() const { return {reach_of(radius_, index_->frame.scale)}; }

  const IndexView* index_;
  Point at_;
  Point inward_;
  double radius_;
  Reach reach_;
  BoxTree::Ball<Reach> boxes_;  // within that reach of the center
};

constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

/// A spot where a wall is measured.
struct Spot {
  Point at;
  Point normal;                   // a unit vector; NaN without one
  std::uint32_t place = kAbsent;  // of the vertex that it is
  std::uint32_t face = kAbsent;   // whose point it is
  double extent = 0;              // of that face
};

/// Measures the distance to what is opposite to a spot.
class OppositeSide {
 public:
  OppositeSide(const IndexView& index, const FaceTree& tree, const Spot& spot)
      : index_(&index),
        tree_(&tree),
        spot_(spot),
        inward_(-1.0 * spot.normal),
        at_(index.frame.to_frame(spot.at)),
        size_(index.frame.scale * std::max(largest_component(spot.at), spot.extent)) {}

  [[nodiscard]] double by_ray() const {
    return has_normal() ? way_to_first([](std::size_t) { return true; }) : kNan;
  }

  /// Returns infinity if the radius of the ball is above the diagonal of the faces.
  [[nodiscard]] double by_sphere(const NormalCones& cones) const {
    if (!has_normal()) return kNan;
    const double scale = index_->frame.scale;
    const double way = way_to_first([&](std::size_t i) { return opposes(i); });
    // A larger one counts no more, and its rounding would hide what is small.
    const double first = std::min(scale * way / 2, 2 * cones.diagonal());
    TouchingBall ball(*index_, at_, inward_, first);
    BoxTree::Walk walk(tree_->boxes(), ball);
    const auto shrink = [&](std::size_t i) {
      if (touches(i) || !ball.may_contain(corners(i)) || !opposes(i)) return;
      ball.limit_to(largest_beside(i, first));
    };
    const auto enters = [&](std::size_t level, std::size_t group) {
      return cones.may_oppose(level, group, spot_.normal);
    };
    while (walk.advance(shrink, [](std::size_t) {}, enters)) {
    }
    return ball.radius() > 0 && ball.radius() <= cones.diagonal() ? 2 * ball.radius() / scale : kInfinity;
  }

 private:
  [[nodiscard]] bool has_normal() const { return !std::isnan(inward_.x); }

  [[nodiscard]] bool touches(std::size_t i) const {
    const Triangle& triangle = tree_->triangles()[i];
    return triangle.face == spot_.face || std::ranges::count(triangle.corners, spot_.place) != 0;
  }

  [[nodiscard]] bool opposes(std::size_t i) const {
    return is_opposite(doubled_area(*index_, tree_->triangles()[i]), spot_.normal);
  }

  /// Returns the way along the ray to the first of the faces for which `is_counted(i)`.
  template <class IsCounted>
  [[nodiscard]] double way_to_first(IsCounted&& is_counted) const {
    const auto counts = [&](std::size_t i, const TrianglePoint& at) {
      return at.distance * index_->frame.scale > same_place(from_spot(i)) && !touches(i) && is_counted(i);
    };
    return find_first_hit(*index_, *tree_, spot_.at, inward_, counts).at.distance;
  }

  [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::size_t i) const {
    return tree_->triangles()[i].corners;
  }

  /// Returns the corners of a triangle relative to the spot, in the unit of the frame. They do not go through the
  /// frame, whose origin may be far away.
  [[nodiscard]] std::array<Point, 3> from_spot(std::size_t i) const {
    std::array<Point, 3> result = corners_of(*index_, corners(i));
    for (Point& corner : result) corner = index_->frame.scale * (corner - spot_.at);
    return result;
  }

  /// Returns the distance up to which a triangle is at the same place.
  [[nodiscard]] double same_place(const std::array<Point, 3>& triangle) const {
    return kSamePlace * std::max({size_, largest_component(triangle[0]), largest_component(triangle[1]),
                                  largest_component(triangle[2])});
  }

  /// Returns the radius, in the frame, of the largest ball beside a triangle, which shrinks from `radius` until the
  /// nearest point of the triangle is not in it. So it depends on no other triangle.
  [[nodiscard]] double largest_beside(std::size_t i, double radius) const {
    const std::array<Point, 3> triangle = from_spot(i);
    const double same = same_place(triangle);
    for (;;) {
      const TrianglePoint nearest = nearest_in_triangle(radius * inward_, triangle, 1);
      const double along = dot(inward_, nearest.point);
      // The ball through the point: smaller if the point is inside. A distance from a center far away would not tell.
      const double smaller = along > same ? dot(nearest.point, nearest.point) / (2 * along) : radius;
      if (!(smaller > 0 && smaller < radius)) return radius;
      radius = smaller;
    }
  }

  const IndexView* index_;
  const FaceTree* tree_;
  Spot spot_;
  Point inward_;
  Point at_;     // in the frame
  double size_;  // of what rounding at the spot depends on, in the unit of the frame
};

/// Returns the point of a face nearest to `q`, and the normal of the face.
Spot spot_on_face(const SurfaceState& state, const FaceTree& tree, std::size_t face, const Point& q) {
  const IndexView& index = *state.index;
  const double scale = index.frame.scale;
  const std::span<const VertexId> corners = state.faces()[face];
  Spot spot{q, {kNan, kNan, kNan}, kAbsent, static_cast<std::uint32_t>(face)};
  Point area{0, 0, 0};
  double least = kInfinity;
  for (const Triangle& triangle : tree.triangles_of(face, corners.size())) {
    const std::array<Point, 3> positions = corners_of(index, triangle.corners);
    const TrianglePoint found = nearest_in_triangle(q, positions, scale);
    if (found.distance < least) spot.at = found.point;
    least = std::min(least, found.distance);
    for (const Point& corner : positions) spot.extent = std::max(spot.extent, largest_component(corner - positions[0]));
    area = area + doubled_area(index, triangle);
  }
  if (const double size = length(area); size > 0) spot.normal = (1 / size) * area;
  return spot;
}

/// Measures at `spot_of(row)`, in the order of `slot_of(row)`, so that spots near each other follow each other.
template <class SlotOf, class SpotOf>
std::vector<double> measure_rows(const SurfaceState& state, const FaceTree& tree, std::size_t rows,
                                 ThicknessMethod method, TaskContext& task, SlotOf&& slot_of, SpotOf&& spot_of) {
  const NormalCones* const cones = method == ThicknessMethod::Sphere ? &state.cones(task) : nullptr;
  std::vector<double> result(rows);
  for_each_by_position(rows, kRowsOfTask, slot_of, task, [&](unsigned thread, std::size_t row) {
    const OppositeSide side(*state.index, tree, spot_of(row));
    result[row] = cones == nullptr ? side.by_ray() : side.by_sphere(*cones);
    task.advance(thread, 1);
  });
  return result;
}

}  // namespace

std::vector<double> thickness(const Surface& surface, const BatchVertices& vertices, ThicknessMethod method,
                              const Run& run) {
  const SurfaceState& state = SurfaceAccess::state(surface);
  const Rows rows({.vertices = vertices, .radius = 0}, state.index->vertex_count());
  TaskContext task(run.threads, run.progress, rows.size());
  const FaceTree& tree = state.tree(task);
  const OrientedIndex oriented = SurfaceAccess::oriented(surface, task);
  return measure_rows(
      state, tree, rows.size(), method, task, [&](std::size_t row) { return state.index->slot[rows.vertex(row)]; },
      [&](std::size_t row) {
        const std::uint32_t place = state.index->place(rows.vertex(row));
        return Spot{oriented.position(place), oriented.normal(place), place};
      });
}

std::vector<double> thickness(const Surface& surface, const IndicesView& faces, std::span<const SpacePoint> points,
                              ThicknessMethod method, const Run& run) {
  const SurfaceState& state = SurfaceAccess::state(surface);
  const FacePoints rows(state.faces(), faces, points);
  TaskContext task(run.threads, run.progress, rows.size());
  const FaceTree& tree = state.tree(task);
  return measure_rows(
      state, tree, rows.size(), method, task, [&](std::size_t row) { return state.index->slot[rows.corners()[row]]; },
      [&](std::size_t row) {
        const auto& [x, y, z] = rows.point(row);
        return spot_on_face(state, tree, rows.face(row), {x, y, z});
      });
}

}  // namespace meshhood::inline v0_1
