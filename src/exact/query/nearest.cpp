// SPDX-License-Identifier: MIT
// The vertex nearest to a point: depth first through the tree, the nearest node of a group first. A node whose bounding
// sphere begins beyond the best vertex found is left out.
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
#include "exact/query/arguments.h"
#include "exact/query/square_range.h"

namespace meshhood {
namespace {

class NearestSearch {
 public:
  NearestSearch(const IndexView& index, const Point& p) : index_(&index), centre_(index.frame, p) {}

  NearestVertex run() {
    for (std::size_t level = index_->tree.size(); level-- > 0;) visit_roots(level);
    return {best_, std::sqrt(square_)};
  }

 private:
  struct Child {
    double low;  // of the squared distances of its vertices
    std::size_t node;
  };

  /// The root groups of a level follow those that the nodes of the level above cover.
  void visit_roots(std::size_t level) {
    const std::size_t covered = level + 1 < index_->tree.size() ? index_->tree[level + 1].nodes : 0;
    for (std::size_t group = index_->levels[level] + covered; group < index_->levels[level + 1]; ++group) {
      visit_group(group);
    }
  }

  void visit_group(std::size_t group) {
    const GroupRecord& record = index_->records[group];
    const Group& spheres = index_->groups[group];
    std::array<Child, kFanOut> children{};
    // At most eight, which the compiler cannot know.
    const std::size_t size = std::min<std::size_t>(record.nodes, kFanOut);
    for (std::size_t i = 0; i < size; ++i) {
      const FrameSphere sphere{spheres.x[i], spheres.y[i], spheres.z[i], spheres.radius[i]};
      children[i] = {squared_distances(sphere, centre_).low, group * kFanOut + i};
    }
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(size),
              [](const Child& a, const Child& b) { return a.low < b.low; });
    for (const Child& child : std::span(children).first(size)) {
      if (child.low > square_) return;  // mutant: nearest-looks-at-one-node
      if (child.node < index_->leaf_count()) {
        visit_leaf(child.node);
      } else {
        visit_group(record.first_child + child.node % kFanOut);
      }
    }
  }

  void visit_leaf(std::size_t leaf) {
    for (std::size_t v = index_->leaf_begin[leaf]; v < index_->leaf_begin[leaf + 1]; ++v) {
      const Point p = std::visit([&](auto xyz) { return point(xyz, v); }, index_->positions);
      const double square = squared_distance(centre_.exact, p);
      if (square > square_) continue;
      const VertexId id = index_->id(v);
      if (square == square_ && best_ < id) continue;  // mutant: nearest-ignores-ties
      square_ = square;
      best_ = id;
    }
  }

  const IndexView* index_;
  Centre centre_;
  double square_ = std::numeric_limits<double>::infinity();
  VertexId best_ = std::numeric_limits<VertexId>::max();
};

}  // namespace

NearestVertex nearest(const Index& index, const SpacePoint& p) {
  check_point(p, "point: ");
  if (index.vertex_count() == 0) raise(ErrorCode::VertexOutOfRange, "nearest: the mesh has no vertices");
  return NearestSearch(IndexAccess::view(index), {p[0], p[1], p[2]}).run();
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
    const Point corner = position_of(IndexAccess::view(index), corners[i]);
    sum = {sum[0] + weights[i] * corner.x, sum[1] + weights[i] * corner.y, sum[2] + weights[i] * corner.z};
  }
  check_point(sum, "point on the face: ");
  return sum;
}

}  // namespace meshhood
