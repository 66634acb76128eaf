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
  void search(const Point& center, Reach&& reach, Visit&& visit) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  template <class Reach, class Visit>
  class Search;

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

template <class Reach, class Visit>
class BoxTree::Search {
 public:
  Search(const BoxTree& tree, const Point& center, Reach& reach, Visit& visit)
      : tree_(&tree),
        kernels_(&kernels(best_isa())),
        center_(center),
        rounded_{static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z)},
        reach_(&reach),
        visit_(&visit) {
    const double largest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z), 1.0});
    is_far_ = largest > kFar;
    rounding_ = is_far_ ? 0x1p-50 : 0x1p-22;
    slack_ = rounding_ * largest;
    limit();
  }

  void visit_group(std::size_t level, std::size_t number) {
    std::array<Child, kFanOut> children;
    const std::size_t size = near_children(level, number, children);
    for (std::size_t i = 0; level > 0 && i < size; ++i) {
      fetch_lines(&tree_->levels_[level - 1][number * kFanOut + children[i].place], sizeof(BoxGroup) / kCacheLine);
    }
    for (std::size_t i = 0; i < size && !(children[i].square > limit_); ++i) {
      const std::size_t child = number * kFanOut + children[i].place;
      if (level > 0) {
        visit_group(level - 1, child);
      } else {
        (*visit_)(child);
        limit();
      }
    }
  }

 private:
  static constexpr double kFar = 64;

  struct Child {
    float square;
    unsigned place;
  };

  /// Those within the limit, in ascending order. Returns their number.
  std::size_t near_children(std::size_t level, std::size_t number, std::array<Child, kFanOut>& children) const {
    BoxGroup::Row squares;
    unsigned near = compare(tree_->levels_[level][number], squares);
    const std::size_t count = std::min<std::size_t>(kFanOut, tree_->sizes_[level] - number * kFanOut);
    near &= (1U << count) - 1;
    std::size_t size = 0;
    for (; near != 0; near &= near - 1) {
      const auto place = static_cast<unsigned>(std::countr_zero(near));
      std::size_t at = size++;
      for (; at > 0 && children[at - 1].square > squares[place]; --at) children[at] = children[at - 1];
      children[at] = {squares[place], place};
    }
    return size;
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

  [[nodiscard]] double square_in_double(const BoxGroup& group, std::size_t i) const {
    const Point below = at(group.low, i) - center_;
    const Point above = center_ - at(group.high, i);
    const Point gap{std::max({below.x, above.x, 0.0}), std::max({below.y, above.y, 0.0}),
                    std::max({below.z, above.z, 0.0})};
    return dot(gap, gap);
  }

  void limit() {
    const double distance = ((*reach_)() + slack_) * (1 + rounding_);
    limit_in_double_ = distance * distance;
    limit_ = next_above(limit_in_double_);  // infinite if it does not fit
  }

  const BoxTree* tree_;
  const Kernels* kernels_;
  Point center_;
  FramePoint rounded_;
  bool is_far_ = false;
  double rounding_ = 0;
  double slack_ = 0;
  double limit_in_double_ = 0;  // of squared distances
  float limit_ = 0;
  Reach* reach_;
  Visit* visit_;
};

template <class Reach, class Visit>
void BoxTree::search(const Point& center, Reach&& reach, Visit&& visit) const {
  Search(*this, center, reach, visit).visit_group(levels_.size() - 1, 0);
}

inline std::size_t BoxTree::bytes() const {
  std::size_t bytes = 0;
  for (const std::vector<BoxGroup>& level : levels_) bytes += level.size() * sizeof(BoxGroup);
  return bytes;
}

}  // namespace meshhood
