// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/frame.h"
#include "base/prefetch.h"
#include "base/vector.h"
#include "simd/kernels.h"
#include "simd/node_group.h"

namespace meshhood {

/// How many times `direction`, whose largest component is 1 or -1, a ray goes to the height of the frame along its main
/// axis; 0 if it begins there or beyond. All are in the frame.
[[nodiscard]] inline double way_to_frame(const Point& origin, const Point& direction) {
  const auto way = [](double from, double along) { return std::abs(along) == 1 ? -1 - from * along : 0; };
  return std::max({way(origin.x, direction.x), way(origin.y, direction.y), way(origin.z, direction.z), 0.0});
}

/// Boxes around items, eight together, boxes around these, and so on up to eight: a tree whose nodes are numbered by
/// their places alone. Items that follow each other should be near each other. 27 bytes an item.
///
/// Boxes are floats that contain what they are made of. `search` measures in single precision, from a point that is
/// rounded, too. Such a distance is off by less than 2^-22 of itself and 2^-22 of the largest coordinate of the point,
/// or of 1, which covers the rounding of coordinates of the frame. `search` adds this error to the distance it is asked
/// for. Far from the mesh the error is large, so there it measures in double.
class BoxTree {
 public:
  /// Makes a tree of `count` items, at least one. `box_of(i)` returns their boxes.
  template <class BoxOf>
  void build(std::size_t count, BoxOf&& box_of);

  /// After some items have moved.
  template <class BoxOf>
  void renew(std::vector<std::size_t> items, BoxOf&& box_of);

  /// Calls `visit(item)` for the items whose box is at most `reach()` away from `center`, and for some others; those of
  /// near nodes first. `reach` is called again after each visit; it never grows. All are in the frame.
  template <class Reach, class Visit>
  void search(const Point& center, Reach&& reach, Visit&& visit) const {
    search(center, reach, visit, kAll);
  }

  /// Without the groups, by level and number, for which `enters` is false.
  template <class Reach, class Visit, class Enters>
  void search(const Point& center, Reach&& reach, Visit&& visit, Enters&& enters) const;

  /// The same for the boxes that the ray from `origin` meets up to `reach()` times `direction`, whose largest component
  /// is 1 or -1: those that it enters first are first.
  template <class Reach, class Visit>
  void cast(const Point& origin, const Point& direction, Reach&& reach, Visit&& visit) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  static constexpr auto kAll = [](std::size_t, std::size_t) { return true; };  // groups

  template <class Reach>
  class Ball;
  template <class Reach>
  class Line;

  /// Visits the items of a group for which `shape` has a bit, in the order of what it measures.
  template <class Shape, class Visit, class Enters>
  void descend(std::size_t level, std::size_t number, Shape& shape, Visit& visit, Enters& enters) const;

  /// That of all boxes of a group.
  [[nodiscard]] BoundingBox box_around(std::size_t level, std::size_t number) const;

  [[nodiscard]] static Point at(const BoxGroup::Corners& corners, std::size_t i) {
    return {static_cast<double>(corners.x[i]), static_cast<double>(corners.y[i]), static_cast<double>(corners.z[i])};
  }

  /// Stores a box at a place of a group.
  static void set(BoxGroup& group, std::size_t i, const BoundingBox& box) {
    group.low.x[i] = -next_above(-box.low.x);
    group.low.y[i] = -next_above(-box.low.y);
    group.low.z[i] = -next_above(-box.low.z);
    group.high.x[i] = next_above(box.high.x);
    group.high.y[i] = next_above(box.high.y);
    group.high.z[i] = next_above(box.high.z);
  }

  std::vector<std::vector<BoxGroup>> levels_;  // the items first
  std::vector<std::size_t> sizes_;             // of the levels, in boxes
};

template <class BoxOf>
void BoxTree::build(std::size_t count, BoxOf&& box_of) {
  levels_.clear();
  sizes_.clear();
  const auto add_level = [&](std::size_t size, auto&& box_at) {
    std::vector<BoxGroup> groups((size + kFanOut - 1) / kFanOut);
    for (std::size_t i = 0; i < size; ++i) set(groups[i / kFanOut], i % kFanOut, box_at(i));
    levels_.push_back(std::move(groups));
    sizes_.push_back(size);
  };
  add_level(count, box_of);
  while (levels_.back().size() > 1) {
    const std::size_t below = levels_.size() - 1;
    add_level(levels_.back().size(), [&](std::size_t i) { return box_around(below, i); });
  }
}

template <class BoxOf>
void BoxTree::renew(std::vector<std::size_t> items, BoxOf&& box_of) {
  for (const std::size_t i : items) set(levels_[0][i / kFanOut], i % kFanOut, box_of(i));
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    for (std::size_t& i : items) i /= kFanOut;
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
    for (const std::size_t i : items) set(levels_[level][i / kFanOut], i % kFanOut, box_around(level - 1, i));
  }
}

inline BoundingBox BoxTree::box_around(std::size_t level, std::size_t number) const {
  const BoxGroup& group = levels_[level][number];
  BoundingBox box;
  for (std::size_t i = 0; i < std::min<std::size_t>(kFanOut, sizes_[level] - number * kFanOut); ++i) {
    box.add(at(group.low, i));
    box.add(at(group.high, i));
  }
  return box;
}

template <class Shape, class Visit, class Enters>
void BoxTree::descend(std::size_t level, std::size_t number, Shape& shape, Visit& visit, Enters& enters) const {
  struct Child {
    float value;
    unsigned place;
  };
  std::array<Child, kFanOut> children;
  std::size_t size = 0;
  BoxGroup::Row values;
  unsigned met = shape.compare(levels_[level][number], values);
  met &= (1U << std::min<std::size_t>(kFanOut, sizes_[level] - number * kFanOut)) - 1;
  for (; met != 0; met &= met - 1) {
    const auto place = static_cast<unsigned>(std::countr_zero(met));
    if (level > 0 && !enters(level - 1, number * kFanOut + place)) continue;
    std::size_t at = size++;
    for (; at > 0 && children[at - 1].value > values[place]; --at) children[at] = children[at - 1];
    children[at] = {values[place], place};
  }
  for (std::size_t i = 0; level > 0 && i < size; ++i) {
    fetch_lines(&levels_[level - 1][number * kFanOut + children[i].place], sizeof(BoxGroup) / kCacheLine);
  }
  for (std::size_t i = 0; i < size && !(children[i].value > shape.limit()); ++i) {
    const std::size_t child = number * kFanOut + children[i].place;
    if (level > 0) {
      descend(level - 1, child, shape, visit, enters);
    } else {
      visit(child);
      shape.update();
    }
  }
}

/// Measures squared distances from a point.
template <class Reach>
class BoxTree::Ball {
 public:
  Ball(const Point& center, Reach& reach)
      : kernels_(&kernels(best_isa())),
        center_(center),
        rounded_{static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)},
        reach_(&reach) {
    const double largest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z), 1.0});
    is_far_ = largest > kFar;
    rounding_ = is_far_ ? 0x1p-50 : 0x1p-22;
    slack_ = rounding_ * largest;
    update();
  }

  /// As the kernel, in double if the center is far.
  unsigned compare(const BoxGroup& group, BoxGroup::Row& squares) const {
    if (!is_far_) return kernels_->box_squares(group, rounded_, limit_, squares);
    unsigned near = 0;
    for (unsigned i = 0; i < kFanOut; ++i) {
      const double square = square_in_double(group, i);
      squares[i] = static_cast<float>(square);
      if (square <= limit_in_double_) near |= 1U << i;
    }
    return near;
  }

  [[nodiscard]] float limit() const { return limit_; }

  void update() {
    const double distance = ((*reach_)() + slack_) * (1 + rounding_);
    limit_in_double_ = distance * distance;
    limit_ = next_above(limit_in_double_);  // infinite if it does not fit
  }

 private:
  static constexpr double kFar = 64;

  [[nodiscard]] double square_in_double(const BoxGroup& group, std::size_t i) const {
    const Point below = at(group.low, i) - center_;
    const Point above = center_ - at(group.high, i);
    const Point gap{std::max({below.x, above.x, 0.0}), std::max({below.y, above.y, 0.0}),
                    std::max({below.z, above.z, 0.0})};
    return dot(gap, gap);
  }

  const Kernels* kernels_;
  Point center_;
  FramePoint rounded_;
  bool is_far_ = false;
  double rounding_ = 0;
  double slack_ = 0;
  double limit_in_double_ = 0;  // of squared distances
  float limit_ = 0;
  Reach* reach_;
};

/// Measures the ways along a ray, from where it comes to the height of the frame along its main axis. All boxes are
/// grown by `slack_`, more than the rounding of positions in single precision, and of origins far away.
template <class Reach>
class BoxTree::Line {
 public:
  Line(const Point& origin, const Point& direction, Reach& reach)
      : kernels_(&kernels(best_isa())),
        begin_(way_to_frame(origin, direction)),
        start_(origin + begin_ * direction),
        slack_(0x1p-20 + 0x1p-48 * (std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}) + begin_)),
        ray_{axis(start_.x, direction.x), axis(start_.y, direction.y), axis(start_.z, direction.z)},
        reach_(&reach) {
    update();
  }

  /// Whether the ray may meet the frame, in which its direction changes a coordinate by at most 2.
  [[nodiscard]] bool may_meet() const {
    return std::max({std::abs(start_.x), std::abs(start_.y), std::abs(start_.z)}) <= 3 + slack_;
  }

  unsigned compare(const BoxGroup& group, BoxGroup::Row& entries) const {
    return kernels_->box_entries(group, ray_, limit_, entries);
  }

  [[nodiscard]] float limit() const { return limit_; }

  void update() { limit_ = next_above((*reach_)() - begin_ + slack_); }

 private:
  /// No inverse is so large that it gives an infinite way.
  [[nodiscard]] BoxRay::Axis axis(double from, double direction) const {
    const double slack = std::copysign(slack_, direction);
    const double along = std::copysign(std::max(std::abs(direction), 0x1p-100), direction);
    return {static_cast<float>(from + slack), static_cast<float>(from - slack), static_cast<float>(1 / along),
            std::signbit(direction)};
  }

  const Kernels* kernels_;
  double begin_;  // the way that is left out
  Point start_;
  double slack_;
  BoxRay ray_;
  float limit_ = 0;
  Reach* reach_;
};

template <class Reach, class Visit, class Enters>
void BoxTree::search(const Point& center, Reach&& reach, Visit&& visit, Enters&& enters) const {
  Ball ball(center, reach);
  descend(levels_.size() - 1, 0, ball, visit, enters);
}

template <class Reach, class Visit>
void BoxTree::cast(const Point& origin, const Point& direction, Reach&& reach, Visit&& visit) const {
  Line line(origin, direction, reach);
  if (line.may_meet()) descend(levels_.size() - 1, 0, line, visit, kAll);
}

inline std::size_t BoxTree::bytes() const {
  std::size_t bytes = 0;
  for (const std::vector<BoxGroup>& level : levels_) bytes += level.size() * sizeof(BoxGroup);
  return bytes;
}

}  // namespace meshhood
