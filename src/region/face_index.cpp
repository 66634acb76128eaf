// SPDX-License-Identifier: MIT
// The triangles of the faces in index order, a tree of boxes around them, and the search for the nearest one.
#include "meshhood/face_index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/bound_index.h"
#include "exact/layout.h"
#include "exact/query/arguments.h"
#include "region/box_tree.h"
#include "region/triangle_point.h"
#include "shared/parallel.h"

namespace meshhood {
namespace {

constexpr std::size_t kPointsOfTask = 256;

// The distance of a face is off by a few units in the last place of itself and of the sides, which are at most 4 in the
// frame. A face whose box is farther away than this much more than another face cannot be nearer.
constexpr double kFaceSlack = 0x1p-43;

// Nor one that is farther away than this much, where squares of distances vanish.
constexpr double kUnderflow = 0x1p-535;

/// The point of a triangle nearest to the origin, by the regions of Ericson, "Real-Time Collision Detection" (2005),
/// sec. 5.1.5. For slivers it may be another point of the triangle, or not a number.
Point roughly_nearest(const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Point ab = b - a;
  const Point ac = c - a;
  const double d1 = -dot(ab, a);
  const double d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -dot(ab, b);
  const double d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const double d5 = -dot(ab, c);
  const double d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  // Rounding may bring several of them below 0.
  if (!(va >= 0 && vb >= 0 && vc >= 0)) return a;
  const double share = 1 / (va + vb + vc);
  return a + (vb * share) * ab + (vc * share) * ac;
}

/// The numbers of the points along a curve of Morton (1966), on which near points mostly follow each other.
std::vector<std::size_t> along_curve(std::span<const SpacePoint> points, const Frame& frame) {
  constexpr double kCells = 1U << 10U;  // an axis
  const auto spread = [](double coordinate) {
    const double cell = std::clamp((coordinate + 1) * (kCells / 2), 0.0, kCells - 1);
    std::uint32_t bits = static_cast<std::uint32_t>(cell);
    bits = (bits | bits << 16U) & 0x030000ffU;
    bits = (bits | bits << 8U) & 0x0300f00fU;
    bits = (bits | bits << 4U) & 0x030c30c3U;
    return (bits | bits << 2U) & 0x09249249U;
  };
  std::vector<std::pair<std::uint32_t, std::size_t>> codes(points.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const Point p = frame.to_frame({points[i][0], points[i][1], points[i][2]});
    codes[i] = {spread(p.x) | spread(p.y) << 1U | spread(p.z) << 2U, i};
  }
  std::sort(codes.begin(), codes.end());
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = codes[i].second;
  return order;
}

}  // namespace

/// A triangle of the fan of a face.
struct Triangle {
  std::array<std::uint32_t, 3> corners;  // places in index order
  std::uint32_t face;
  std::uint32_t second;  // see `SurfacePoint::second_corner`
};

/// The triangles in the order of their first corners in index order, then of their faces.
struct FaceIndex::State {
  explicit State(const Index& owner) : index(owner) {}

  BoundIndex index;
  std::size_t face_count = 0;  // of the mesh
  std::vector<Triangle> triangles;
  BoxTree boxes;

  void sort_triangles(const FacesView& faces);

  [[nodiscard]] std::array<Point, 3> corners_of(const Triangle& triangle) const {
    return std::visit(
        [&](auto xyz) {
          const auto& [a, b, c] = triangle.corners;
          return std::array{point(xyz, a), point(xyz, b), point(xyz, c)};
        },
        index->positions);
  }
};

/// Counting sort by the corner that comes first in index order.
void FaceIndex::State::sort_triangles(const FacesView& faces) {
  const IndexView& view = *index;
  face_count = faces.size();
  const auto place_of = [&](VertexId v) { return view.leaf_begin[leaf_of(view.slot[v])] + lane_of(view.slot[v]); };
  const auto for_each_triangle = [&](auto&& f) {
    faces.for_each([&](std::size_t face, std::span<const VertexId> all) {
      for (std::size_t second = 1; second + 1 < all.size(); ++second) {
        const Triangle triangle{{place_of(all[0]), place_of(all[second]), place_of(all[second + 1])},
                                static_cast<std::uint32_t>(face),
                                static_cast<std::uint32_t>(second)};
        f(std::ranges::min(triangle.corners), triangle);
      }
    });
  };
  std::vector<std::size_t> next(view.vertex_count() + 1, 0);
  for_each_triangle([&](std::uint32_t first, const Triangle&) { ++next[first + std::size_t{1}]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  if (next.back() == 0) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
  triangles.resize(next.back());
  for_each_triangle([&](std::uint32_t first, const Triangle& triangle) { triangles[next[first]++] = triangle; });
}

/// A triangle is first compared roughly, which bounds its distance from both sides. Only those that no other one
/// excludes are measured exactly, at the end.
class FaceIndex::Search {
 public:
  explicit Search(const State& state) : state_(&state), scale_(state.index->frame.scale) {}

  /// Begins with the last answer, which is near if the points are.
  SurfacePoint run(const Point& q) {
    q_ = q;
    in_frame_ = state_->index->frame.to_frame(q);
    reach_ = std::numeric_limits<double>::infinity();
    best_.distance = std::numeric_limits<double>::infinity();
    const std::size_t first = nearest_;
    compare(first);
    state_->boxes.search(
        in_frame_, [&] { return reach_; },
        [&](std::size_t i) {
          if (i != first) compare(i);
        });
    measure();
    const Triangle& triangle = state_->triangles[nearest_];
    SurfacePoint found{triangle.face, triangle.second, {}, best_.weights, {best_.point.x, best_.point.y, best_.point.z},
                       best_.distance};
    for (std::size_t i = 0; i < 3; ++i) found.vertices[i] = state_->index->id(triangle.corners[i]);
    return found;
  }

 private:
  struct Candidate {
    std::size_t triangle;
    double least;  // of its squared distances, in the frame; may be not a number
  };

  /// No point of a triangle is nearer than its corners are along any direction; that to its nearest point tells the
  /// most.
  void compare(std::size_t i) {
    std::array<Point, 3> from_q;
    for (std::size_t k = 0; k < 3; ++k) {
      from_q[k] = state_->index->in_frame(state_->triangles[i].corners[k]) - in_frame_;
    }
    const Point nearest = roughly_nearest(from_q);
    const double along = std::min({dot(nearest, from_q[0]), dot(nearest, from_q[1]), dot(nearest, from_q[2])});
    const double square = dot(nearest, nearest);
    const double least = along > 0 ? along * along / square : 0;
    if (is_far(least)) return;
    limit_to(std::sqrt(square));
    if (size_ == candidates_.size()) measure();
    candidates_[size_++] = {i, least};
  }

  [[nodiscard]] bool is_far(double least) const { return least > reach_ * reach_; }

  /// There is a triangle at this distance, in the frame.
  void limit_to(double distance) {
    reach_ = std::min(reach_, distance + kFaceSlack * (distance + 4) + kUnderflow * scale_);
  }

  /// The candidates that are left, exactly.
  void measure() {
    for (const Candidate& candidate : std::span(candidates_).first(std::exchange(size_, 0))) {
      if (is_far(candidate.least)) continue;
      const Triangle& triangle = state_->triangles[candidate.triangle];
      const TrianglePoint found = nearest_in_triangle(q_, state_->corners_of(triangle), scale_);
      const Triangle& nearest = state_->triangles[nearest_];
      const bool is_nearer = found.distance < best_.distance ||
                             (found.distance == best_.distance &&
                              std::pair(triangle.face, triangle.second) < std::pair(nearest.face, nearest.second));
      if (!is_nearer) continue;
      best_ = found;
      nearest_ = candidate.triangle;
      limit_to(best_.distance * scale_);
    }
  }

  const State* state_;
  double scale_;
  Point q_{};
  Point in_frame_{};
  double reach_ = 0;  // in the frame: what is farther cannot be the nearest
  std::array<Candidate, 16> candidates_{};
  std::size_t size_ = 0;
  TrianglePoint best_{};
  std::size_t nearest_ = 0;  // of `triangles`
};

FaceIndex FaceIndex::build(const Index& index, const FacesView& faces) {
  validate(MeshView{index.positions(), faces});
  if (faces.size() > std::numeric_limits<std::uint32_t>::max()) {
    raise(ErrorCode::TooLarge, std::to_string(faces.size()) + " faces, expected at most 2^32 - 1");
  }
  auto state = std::make_unique<State>(index);
  state->sort_triangles(faces);
  state->boxes.build(state->triangles.size(), [&](std::size_t i) {
    Box box;
    for (const std::uint32_t place : state->triangles[i].corners) box.add(state->index->in_frame(place));
    return box;
  });
  return FaceIndex(std::move(state));
}

FaceIndex::FaceIndex(std::unique_ptr<const State> state) : state_(std::move(state)) {}

std::size_t FaceIndex::face_count() const { return state_->face_count; }

std::size_t FaceIndex::bytes() const { return state_->triangles.size() * sizeof(Triangle) + state_->boxes.bytes(); }

SurfacePoint FaceIndex::closest_point(const SpacePoint& point) const {
  state_->index.check_current();
  check_point(point, "point: ");
  return Search(*state_).run({point[0], point[1], point[2]});
}

std::vector<SurfacePoint> FaceIndex::closest_points(std::span<const SpacePoint> points,
                                                    const BatchOptions& options) const {
  state_->index.check_current();
  for (std::size_t i = 0; i < points.size(); ++i) check_point(points[i], "points: row " + std::to_string(i) + ": ");
  const std::vector<std::size_t> in_order = along_curve(points, state_->index->frame);
  TaskContext task(options.threads, options.progress, points.size());
  std::vector<SurfacePoint> found(points.size());
  task.parallel_for(points.size(), kPointsOfTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
    Search search(*state_);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [x, y, z] = points[in_order[i]];
      found[in_order[i]] = search.run({x, y, z});
    }
    task.advance(thread, end - begin);
  });
  task.finish();
  return found;
}

}  // namespace meshhood
