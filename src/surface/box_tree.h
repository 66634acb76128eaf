// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/frame.h"
#include "base/lists.h"
#include "base/prefetch.h"
#include "base/vector.h"
#include "simd/kernels.h"
#include "simd/node_group.h"

namespace meshhood::inline v0_1 {

/// Returns how many times `direction`, whose largest component is 1 or -1, a ray goes to the height of the frame along
/// its main axis; 0 if it begins there or beyond. All are in the frame.
[[nodiscard]] inline double way_to_frame(const Point& origin, const Point& direction) {
  const auto way = [](double from, double along) { return std::abs(along) == 1 ? -1 - from * along : 0; };
  return std::max({way(origin.x, direction.x), way(origin.y, direction.y), way(origin.z, direction.z), 0.0});
}

/// Boxes around items, eight together, boxes around these, and so on up to eight: a tree whose nodes are numbered by
/// their places alone. Items that follow each other should be near each other. It takes 27 bytes an item.
///
/// Boxes are floats that contain what they are made of. `search` measures in single precision, from a point that is
/// rounded, too. Such a distance is off by less than 2^-22 of itself and 2^-22 of the largest coordinate of the point,
/// or of 1, which covers the rounding of coordinates of the frame. `search` adds this error to the distance it is asked
/// for. Far from the mesh the error is large, so there it measures in double.
class BoxTree {
 public:
  /// Makes a tree of `count` items, which may be none. `box_of(i)` returns their boxes.
  template <class BoxOf>
  void build(std::size_t count, BoxOf&& box_of);

  /// Updates the tree after some items have moved.
  template <class BoxOf>
  void renew(std::vector<std::size_t> items, BoxOf&& box_of);

  /// For `enters`: leaves out no group.
  struct All {
    bool operator()(std::size_t /*level*/, std::size_t /*number*/) const { return true; }
  };

  /// Calls `visit(item)` for the items whose box is at most `reach()` away from `center`, and for some others; those of
  /// near nodes first. `reach` is called again after each visit; it never grows. All are in the frame. Leaves out the
  /// groups, by level and number, for which `enters` is false.
  template <class Reach, class Visit, class Enters = All>
  void search(const Point& center, Reach&& reach, Visit&& visit, Enters&& enters = {}) const;

  template <class Shape>
  class Walk;
  template <class Reach>
  class Ball;
  template <class Reach>
  class Line;

  [[nodiscard]] std::size_t bytes() const;

 private:
  /// Returns the box around all boxes of a group.
  [[nodiscard]] BoundingBox box_around(std::size_t level, std::size_t number) const;

  [[nodiscard]] static Point at(const BoxGroup::Corners& corners, std::size_t i) {
    return {static_cast<double>(corners.x[i]), static_cast<double>(corners.y[i]), static_cast<double>(corners.z[i])};
  }

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
    std::vector<BoxGroup> groups(std::max<std::size_t>(1, (size + kFanOut - 1) / kFanOut));
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
    sort_out(items);
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

/// Walks from the root, to near boxes before far ones. A loop that advances several by turns hides the latency of
/// memory. `Shape` measures boxes, never below 0.
template <class Shape>
class BoxTree::Walk {
 public:
  /// Tree and shape must outlive it.
  Walk(const BoxTree& tree, Shape& shape) : tree_(&tree), shape_(&shape) {
    boxes_[0] = 0;
    heights_[0] = static_cast<std::uint8_t>(tree.levels_.size());
  }

  /// Calls `visit(item)` for the next items, then opens one group. If this group holds items, calls `fetch(item)` for
  /// those that may be visited later. Returns false at the end.
  template <class Visit, class Fetch, class Enters = All>
  bool advance(Visit&& visit, Fetch&& fetch, Enters&& enters = {});

 private:
  template <class Fetch, class Enters>
  void open(std::size_t level, std::size_t number, Fetch& fetch, Enters& enters);

  static constexpr std::size_t kMostBoxes = std::size_t{11} * kFanOut;  // enough for 2^32 items

  const BoxTree* tree_;
  Shape* shape_;
  // The boxes or items that are left, the next one last: the bits of what `Shape` measured, then the number. The bits
  // of floats that are not negative have the order of the floats.
  std::array<std::uint64_t, kMostBoxes> boxes_;
  std::array<std::uint8_t, kMostBoxes> heights_;  // levels below the box; 0 for items
  std::size_t size_ = 1;
};

template <class Shape>
template <class Visit, class Fetch, class Enters>
bool BoxTree::Walk<Shape>::advance(Visit&& visit, Fetch&& fetch, Enters&& enters) {
  while (size_ > 0) {
    const std::uint64_t box = boxes_[--size_];
    const std::size_t height = heights_[size_];
    const auto number = static_cast<std::uint32_t>(box);
    if (std::bit_cast<float>(static_cast<std::uint32_t>(box >> 32U)) > shape_->limit()) continue;
    if (height > 0) {
      open(height - 1, number, fetch, enters);
      return true;
    }
    visit(std::size_t{number});
    shape_->update();
  }
  return false;
}

template <class Shape>
template <class Fetch, class Enters>
void BoxTree::Walk<Shape>::open(std::size_t level, std::size_t number, Fetch& fetch, Enters& enters) {
  BoxGroup::Row values;
  const std::size_t first = number * kFanOut;
  unsigned met = shape_->compare(tree_->levels_[level][number], values);
  met &= (1U << std::min<std::size_t>(kFanOut, tree_->sizes_[level] - first)) - 1;
  std::size_t size = size_;
  for (; met != 0; met &= met - 1) {
    const auto place = static_cast<unsigned>(std::countr_zero(met));
    const std::size_t child = first + place;
    if (level == 0) {
      fetch(child);
    } else {
      if (!enters(level - 1, child)) continue;
      fetch_lines(&tree_->levels_[level - 1][child], sizeof(BoxGroup) / kCacheLine);
    }
    std::uint64_t box = std::uint64_t{std::bit_cast<std::uint32_t>(values[place])} << 32U | child;
    for (std::size_t at = size_; at < size; ++at) {  // no branch depends on what is measured
      const std::uint64_t other = std::exchange(boxes_[at], std::max(box, boxes_[at]));
      box = std::min(box, other);
    }
    boxes_[size] = box;
    heights_[size++] = static_cast<std::uint8_t>(level);
  }
  size_ = size;
}

/// Measures squared distances from a point, in the frame.
template <class Reach>
class BoxTree::Ball {
 public:
  /// `reach` must outlive it.
  Ball(const Point& center, Reach& reach)
      : kernels_(&kernels(best_isa())),
        center_(center),
        rounded_{static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)},
        reach_(&reach) {
    const double largest = std::max(largest_component(center), 1.0);
    is_far_ = largest > kFar;
    rounding_ = is_far_ ? 0x1p-50 : 0x1p-22;
    slack_ = rounding_ * largest;
    update();
  }

  /// Compares as the kernel, but in double if the center is far.
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

/// Measures the ways along the ray from `origin`, up to `reach()` times `direction`, whose largest component is 1 or
/// -1, from where it comes to the height of the frame along its main axis. All are in the frame. All boxes are grown by
/// `slack_`, more than the rounding of positions in single precision, and of origins far away.
template <class Reach>
class BoxTree::Line {
 public:
  Line(const Point& origin, const Point& direction, Reach& reach)
      : kernels_(&kernels(best_isa())),
        begin_(way_to_frame(origin, direction)),
        start_(origin + begin_ * direction),
        slack_(0x1p-20 + 0x1p-48 * (largest_component(origin) + begin_)),
        ray_{axis(start_.x, direction.x), axis(start_.y, direction.y), axis(start_.z, direction.z)},
        reach_(&reach) {
    // In the frame, the direction changes a coordinate by at most 2.
    const bool may_meet = largest_component(start_) <= 3 + slack_;
    if (may_meet) update();
  }

  unsigned compare(const BoxGroup& group, BoxGroup::Row& entries) const {
    return kernels_->box_entries(group, ray_, limit_, entries);
  }

  [[nodiscard]] float limit() const { return limit_; }

  void update() {
    const double reach = (*reach_)();
    if (reach == reached_) return;
    reached_ = reach;
    limit_ = next_above(reach - begin_ + slack_);
  }

 private:
  /// No inverse is so large that it gives an infinite way.
  [[nodiscard]] BoxRay::Axis axis(double from, double direction) const {
    const double along = std::copysign(std::max(std::abs(direction), 0x1p-100), direction);
    return {static_cast<float>(from + slack_), static_cast<float>(from - slack_), static_cast<float>(1 / along)};
  }

  const Kernels* kernels_;
  double begin_;  // the way that is left out
  Point start_;
  double slack_;
  BoxRay ray_;
  double reached_ = -1;  // what `limit_` was made of
  float limit_ = -1;
  Reach* reach_;
};

template <class Reach, class Visit, class Enters>
void BoxTree::search(const Point& center, Reach&& reach, Visit&& visit, Enters&& enters) const {
  Ball ball(center, reach);
  Walk walk(*this, ball);
  while (walk.advance(visit, [](std::size_t) {}, enters)) {
  }
}

inline std::size_t BoxTree::bytes() const {
  std::size_t bytes = 0;
  for (const std::vector<BoxGroup>& level : levels_) bytes += level.size() * sizeof(BoxGroup);
  return bytes;
}

}  // namespace meshhood::inline v0_1
