// SPDX-License-Identifier: MIT
#include "region/polylines.h"

#include <numeric>

namespace meshhood {
namespace {

class Joiner {
 public:
  Joiner(std::span<const Segment> segments, std::size_t points)
      : segments_(segments), begin_(points + 1), of_point_(2 * segments.size()), is_used_(segments.size()) {
    for (const Segment& segment : segments) {
      ++begin_[segment.from];
      ++begin_[segment.to];
    }
    std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());
    for (std::size_t i = segments.size(); i-- > 0;) {
      of_point_[--begin_[segments[i].from]] = i;
      of_point_[--begin_[segments[i].to]] = i;
    }
  }

  std::vector<Polyline> join() {
    std::vector<Polyline> result;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i] && is_end(segments_[i].from)) result.push_back(walk(i, segments_[i].from));
    }
    // Segments that run against the others, where faces are not consistently oriented.
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i] && is_end(segments_[i].to)) result.push_back(walk(i, segments_[i].to));
    }
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i]) result.push_back(walk(i, segments_[i].from));
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_end(std::uint32_t point) const { return begin_[point + 1] - begin_[point] != 2; }

  /// From `start`, an end of segment `next`, to an end or back to `start`.
  Polyline walk(std::size_t next, std::uint32_t start) {
    Polyline line{{start}, false};
    std::uint32_t at = start;
    while (true) {
      is_used_[next] = true;
      at = segments_[next].from == at ? segments_[next].to : segments_[next].from;
      if (at == start && !is_end(at)) {
        line.is_closed = true;
        return line;
      }
      line.points.push_back(at);
      if (is_end(at)) return line;
      const std::size_t first = of_point_[begin_[at]];
      next = is_used_[first] ? of_point_[begin_[at] + 1] : first;
    }
  }

  std::span<const Segment> segments_;
  std::vector<std::size_t> begin_;     // by point: where its segments begin in `of_point_`
  std::vector<std::size_t> of_point_;  // segments
  std::vector<bool> is_used_;
};

}  // namespace

std::vector<Polyline> join_segments(std::span<const Segment> segments, std::size_t points) {
  return Joiner(segments, points).join();
}

}  // namespace meshhood
