// SPDX-License-Identifier: MIT
// The faces by the leaves of the index, and the search for the nearest one.
#include "meshhood/face_index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <variant>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/bound_index.h"
#include "exact/layout.h"
#include "exact/node_search.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_first.h"
#include "region/triangle_point.h"
#include "shared/parallel.h"

namespace meshhood {
namespace {

constexpr std::size_t kPointsOfTask = 64;

// The distance of a face is off by a few units in the last place of itself and of the sides, which are at most 4 in the
// frame. A face whose bounding box is farther away than this much more than another face cannot be nearer.
constexpr double kFaceSlack = 0x1p-43;

std::uint32_t leaf_of_place(const IndexView& index, std::uint32_t place) {
  return leaf_of(index.slot[index.id(place)]);
}

}  // namespace

/// The faces in the order of their leaves, then of their numbers.
struct FaceIndex::State {
  explicit State(const Index& owner) : index(owner) {}

  BoundIndex index;
  std::size_t face_count = 0;                     // of the mesh
  std::vector<std::uint32_t> first_face;          // by leaf, and one more: in the arrays that follow
  std::vector<std::uint32_t> faces;               // the number of each in the mesh
  std::vector<std::size_t> first_corner;          // of each, and one more: in `corners`
  std::vector<std::uint32_t> corners;             // places in index order
  std::vector<float> overhang;                    // by node (see `VertexVisitor`)
  std::vector<std::vector<float>> root_overhang;  // by level over the root groups

  void sort_faces(const FacesView& given);
  void measure_overhang();
  void measure_overhang(LeafId leaf, std::span<const std::uint32_t> face);
  void measure_roots();

  [[nodiscard]] std::span<const std::uint32_t> corners_of(std::size_t i) const {
    return std::span(corners).subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
  }
};

/// Counting sort by the leaf of the corner that comes first in index order.
void FaceIndex::State::sort_faces(const FacesView& given) {
  const IndexView& view = *index;
  face_count = given.size();
  first_face.assign(view.leaf_count() + 1, 0);
  std::vector<std::uint32_t> leaf_of_face(given.size());
  std::size_t kept = 0;
  std::size_t kept_corners = 0;
  const auto place_of = [&](VertexId v) { return view.leaf_begin[leaf_of(view.slot[v])] + lane_of(view.slot[v]); };
  given.for_each([&](std::size_t face, std::span<const VertexId> all) {
    if (all.size() < 3) return;
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    for (const VertexId v : all) first = std::min(first, place_of(v));
    leaf_of_face[face] = leaf_of_place(view, first);
    ++first_face[leaf_of_face[face] + 1];
    ++kept;
    kept_corners += all.size();
  });
  if (kept == 0) raise(ErrorCode::InvalidMesh, "the mesh has no face of three corners, expected faces");
  for (std::size_t leaf = 0; leaf < view.leaf_count(); ++leaf) first_face[leaf + 1] += first_face[leaf];
  std::vector<std::uint32_t> next(first_face.begin(), first_face.end() - 1);
  std::vector<std::uint32_t> rank(given.size());
  faces.resize(kept);
  first_corner.assign(kept + 1, 0);
  given.for_each([&](std::size_t face, std::span<const VertexId> all) {
    if (all.size() < 3) return;
    rank[face] = next[leaf_of_face[face]]++;
    faces[rank[face]] = static_cast<std::uint32_t>(face);
    first_corner[rank[face] + std::size_t{1}] = all.size();
  });
  for (std::size_t i = 0; i < kept; ++i) first_corner[i + 1] += first_corner[i];
  corners.resize(kept_corners);
  given.for_each([&](std::size_t face, std::span<const VertexId> all) {
    if (all.size() < 3) return;
    std::transform(all.begin(), all.end(), corners.begin() + static_cast<std::ptrdiff_t>(first_corner[rank[face]]),
                   place_of);
  });
}

void FaceIndex::State::measure_overhang() {
  overhang.assign(index->records.size() * kFanOut, 0);
  for (LeafId leaf = 0; leaf < index->leaf_count(); ++leaf) {
    for (std::size_t i = first_face[leaf]; i < first_face[leaf + std::size_t{1}]; ++i) {
      measure_overhang(leaf, corners_of(i));
    }
  }
  measure_roots();
}

/// Raises the overhang of the nodes over a leaf that do not hold all corners of one of its faces.
void FaceIndex::State::measure_overhang(LeafId leaf, std::span<const std::uint32_t> face) {
  for (NodeId node = leaf; node != kNoNode; node = index->parents[node / kFanOut]) {
    const GroupRecord& record = index->records[node / kFanOut];
    const FrameSphere sphere = sphere_of(index->groups[node / kFanOut], node % kFanOut);
    bool holds_all = true;
    for (const std::uint32_t place : face) {
      if (place >= record.begin[node % kFanOut] && place < record.begin[node % kFanOut + 1]) continue;
      holds_all = false;
      const double beyond = length(index->in_frame(place) - center_of(sphere)) - static_cast<double>(sphere.radius);
      if (beyond > static_cast<double>(overhang[node])) overhang[node] = next_above(beyond);
    }
    if (holds_all) return;
  }
}

/// A sphere of the tree over the root groups encloses those below it, which overhang at most as far as one of their
/// nodes.
void FaceIndex::State::measure_roots() {
  const RootTree& roots = index->roots;
  for (std::size_t level = 0; level < roots.levels.size(); ++level) {
    std::vector<float> most(roots.levels[level].size(), 0);
    for (std::size_t i = 0; i < most.size(); ++i) {
      const std::span<const float> below =
          level == 0 ? std::span<const float>(overhang).subspan(std::size_t{roots.groups[i]} * kFanOut, kFanOut)
                     : std::span<const float>(root_overhang[level - 1]).subspan(i * kFanOut);
      for (const float value : below.first(std::min<std::size_t>(below.size(), kFanOut))) {
        most[i] = std::max(most[i], value);
      }
    }
    root_overhang.push_back(std::move(most));
  }
}

class FaceIndex::Search : public VertexVisitor {
 public:
  Search(const State& state, const Point& q) : state_(&state), center_(state.index->frame, q) {}

  SurfacePoint run() {
    NearestFirst(*state_->index, center_, *this).run();
    const std::span<const std::uint32_t> face = state_->corners_of(face_);
    const std::array<std::size_t, 3> triangle{0, second_, second_ + 1};
    SurfacePoint found{number_,       second_, {}, best_.weights, {best_.point.x, best_.point.y, best_.point.z},
                       best_.distance};
    for (std::size_t i = 0; i < 3; ++i) found.vertices[i] = state_->index->id(face[triangle[i]]);
    return found;
  }

  [[nodiscard]] double reach() const { return best_.distance; }
  [[nodiscard]] float overhang(NodeId node) const { return state_->overhang[node]; }
  [[nodiscard]] float root_overhang(std::size_t level, std::size_t number) const {
    return state_->root_overhang[level][number];
  }

  void visit_leaf(LeafId leaf) {
    std::visit(
        [&](auto xyz) {
          const std::size_t end = state_->first_face[leaf + std::size_t{1}];
          for (std::size_t i = state_->first_face[leaf]; i < end; ++i) visit_face(i, xyz);
        },
        state_->index->positions);
  }

 private:
  template <class Real>
  void visit_face(std::size_t i, std::span<const Real> xyz) {
    const std::span<const std::uint32_t> face = state_->corners_of(i);
    std::array<Point, 3> corners{point(xyz, face[0]), point(xyz, face[1]), {}};
    for (std::size_t second = 1; second + 1 < face.size(); ++second, corners[1] = corners[2]) {
      corners[2] = point(xyz, face[second + 1]);
      if (is_far(corners)) continue;
      const TrianglePoint found = nearest_in_triangle(center_.exact, corners, state_->index->frame.scale);
      const std::size_t number = state_->faces[i];
      const bool is_nearer = found.distance < best_.distance || (found.distance == best_.distance && number < number_);
      if (!is_nearer) continue;
      best_ = found;
      number_ = number;
      face_ = i;
      second_ = second;
      const double limit = best_.distance + kFaceSlack * (best_.distance + 4 * center_.unit);
      squared_limit_ = limit * limit;
    }
  }

  /// Whether the bounding box of a triangle is farther away than the nearest face so far.
  [[nodiscard]] bool is_far(const std::array<Point, 3>& corners) const {
    const auto gap = [&](double Point::* axis) {
      const double low = std::min(std::min(corners[0].*axis, corners[1].*axis), corners[2].*axis);
      const double high = std::max(std::max(corners[0].*axis, corners[1].*axis), corners[2].*axis);
      return std::max(std::max(low - center_.exact.*axis, center_.exact.*axis - high), 0.0);
    };
    const double x = gap(&Point::x);
    const double y = gap(&Point::y);
    const double z = gap(&Point::z);
    return x * x + y * y + z * z > squared_limit_;
  }

  const State* state_;
  Center center_;
  TrianglePoint best_{{}, {}, std::numeric_limits<double>::infinity()};
  double squared_limit_ = std::numeric_limits<double>::infinity();
  std::size_t number_ = std::numeric_limits<std::size_t>::max();  // of the nearest face
  std::size_t face_ = 0;                                          // its place in the arrays
  std::size_t second_ = 1;
};

FaceIndex FaceIndex::build(const Index& index, const FacesView& faces) {
  validate(MeshView{index.positions(), faces});
  if (faces.size() > std::numeric_limits<std::uint32_t>::max()) {
    raise(ErrorCode::TooLarge, std::to_string(faces.size()) + " faces, expected at most 2^32 - 1");
  }
  auto state = std::make_unique<State>(index);
  state->sort_faces(faces);
  state->measure_overhang();
  return FaceIndex(std::move(state));
}

FaceIndex::FaceIndex(std::unique_ptr<const State> state) : state_(std::move(state)) {}

std::size_t FaceIndex::face_count() const { return state_->face_count; }

std::size_t FaceIndex::bytes() const {
  const auto bytes_of = [](const auto& array) { return array.size() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(state_->first_face) + bytes_of(state_->faces) + bytes_of(state_->first_corner) +
                      bytes_of(state_->corners) + bytes_of(state_->overhang);
  for (const std::vector<float>& level : state_->root_overhang) bytes += bytes_of(level);
  return bytes;
}

SurfacePoint FaceIndex::closest_point(const SpacePoint& point) const {
  state_->index.check_current();
  check_point(point, "point: ");
  return Search(*state_, {point[0], point[1], point[2]}).run();
}

std::vector<SurfacePoint> FaceIndex::closest_points(std::span<const SpacePoint> points, const Run& run) const {
  state_->index.check_current();
  for (std::size_t i = 0; i < points.size(); ++i) check_point(points[i], "points: row " + std::to_string(i) + ": ");
  TaskContext task(run.threads, run.progress, points.size());
  std::vector<SurfacePoint> found(points.size());
  task.parallel_for(points.size(), kPointsOfTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      found[i] = Search(*state_, {points[i][0], points[i][1], points[i][2]}).run();
    }
    task.advance(thread, end - begin);
  });
  task.finish();
  return found;
}

}  // namespace meshhood
