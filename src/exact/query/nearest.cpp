// SPDX-License-Identifier: MIT
// The vertex nearest to a point: depth first through the tree, the nearest node of a group first. A node is skipped if
// its bounding sphere is farther away than the nearest vertex so far.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "meshhood/error.h"
#include "meshhood/start.h"

#include "exact/index_access.h"
#include "exact/node_search.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "shared/text.h"

namespace meshhood {
namespace {

class NearestSearch {
 public:
  NearestSearch(const IndexView& index, const Point& p) : index_(&index), center_(index.frame, p) {}

  NearestVertex run() {
    visit_roots(index_->roots.levels.size() - 1, 0);
    return {best_, distance_};
  }

 private:
  struct Child {
    double low;  // of the distances of its vertices
    std::size_t place;
  };

  /// Visits up to eight spheres of a level over the root groups, from `first` on.
  void visit_roots(std::size_t level, std::size_t first) {
    const RootTree& roots = index_->roots;
    const std::span<const FrameSphere> spheres = std::span(roots.levels[level]).subspan(first);
    const auto sphere_at = [&](std::size_t i) { return spheres[i]; };
    visit_nearest_first(spheres.size(), sphere_at, [&](std::size_t i) {
      if (level == 0) {
        visit_group(roots.groups[first + i]);
      } else {
        visit_roots(level - 1, (first + i) * kFanOut);
      }
    });
  }

  void visit_group(std::size_t group) {
    const GroupRecord& record = index_->records[group];
    const Group& spheres = index_->groups[group];
    const auto sphere_at = [&](std::size_t i) { return sphere_of(spheres, i); };
    visit_nearest_first(record.nodes, sphere_at, [&](std::size_t i) {
      const std::size_t node = group * kFanOut + i;
      if (node < index_->leaf_count()) {
        visit_leaf(node);
      } else {
        visit_group(record.first_child + i);
      }
    });
  }

  /// Calls `visit(i)` for up to eight of `count` spheres, the nearest first, as long as they may hold a nearer vertex.
  template <class SphereAt, class Visit>
  void visit_nearest_first(std::size_t count, SphereAt&& sphere_at, Visit&& visit) {
    std::array<Child, kFanOut> children{};
    const std::size_t size = std::min<std::size_t>(count, kFanOut);
    for (std::size_t i = 0; i < size; ++i) children[i] = {std::sqrt(squared_distances(sphere_at(i), center_).low), i};
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(size),
              [](const Child& a, const Child& b) { return a.low < b.low; });
    for (const Child& child : std::span(children).first(size)) {
      if (child.low > distance_) return;
      visit(child.place);
    }
  }

  void visit_leaf(std::size_t leaf) {
    for (std::size_t v = index_->leaf_begin[leaf]; v < index_->leaf_begin[leaf + 1]; ++v) {
      const Point p = std::visit([&](auto xyz) { return point(xyz, v); }, index_->positions);
      const double distance = std::sqrt(squared_distance(center_.exact, p));  // different squares may have one root
      if (distance > distance_) continue;
      const VertexId id = index_->id(v);
      if (distance == distance_ && best_ < id) continue;
      distance_ = distance;
      best_ = id;
    }
  }

  const IndexView* index_;
  Center center_;
  double distance_ = std::numeric_limits<double>::infinity();
  VertexId best_ = std::numeric_limits<VertexId>::max();
};

}  // namespace

NearestVertex nearest(const Index& index, const SpacePoint& p) {
  check_point(p, "point: ");
  if (index.vertex_count() == 0) raise(ErrorCode::VertexOutOfRange, "nearest: the mesh has no vertices");
  return NearestSearch(IndexAccess::view(index), {p[0], p[1], p[2]}).run();
}

Start Start::nearest(const Index& index, const SpacePoint& center) {
  Start start(meshhood::nearest(index, center).vertex);
  start.center_ = center;
  return start;
}

SpacePoint point_on_face(const Index& index, std::span<const VertexId> corners, std::span<const double> weights) {
  if (weights.size() != corners.size()) {
    raise(ErrorCode::InvalidOption, "weights: " + std::to_string(weights.size()) +
                                        " values, expected one for each of " + std::to_string(corners.size()) +
                                        " corners");
  }
  SpacePoint sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    check_vertex(corners[i], index.vertex_count(), "corner " + std::to_string(i) + ": vertex");
    if (!std::isfinite(weights[i])) {
      raise(ErrorCode::InvalidOption,
            "weights: value " + std::to_string(i) + " is " + to_text(weights[i]) + ", expected a finite number");
    }
    const Point corner = position_of(IndexAccess::view(index), corners[i]);
    sum = {sum[0] + weights[i] * corner.x, sum[1] + weights[i] * corner.y, sum[2] + weights[i] * corner.z};
  }
  check_point(sum, "point on the face: ");
  return sum;
}

}  // namespace meshhood
