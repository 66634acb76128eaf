// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace meshhood::io {

/// Makes one vertex of all corners of equal position (-0 equals 0), numbered in order of first appearance.
///
/// Sorts rather than hashes, so that no file can be made slow. Corners are welded a batch at a time: at no time is the
/// whole soup in memory. Memory beside the result: 4 bytes a vertex, and at most 28 (as double 40) a corner of a batch,
/// which has an eighth as many corners as there are vertices. O(n log n).
template <class Real>
class VertexWelder {
 public:
  using Point = std::array<Real, 3>;

  /// `positions` (#V by 3) and `corners` receive the result; both must be empty and outlive this. `file` is for errors.
  VertexWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& corners, std::string file)
      : positions_(positions), corners_(corners), file_(std::move(file)) {}

  /// Takes finite coordinates. Throws Error{TooLarge}.
  void append(const Point& corner) {
    batch_.push_back(corner);
    if (batch_.size() >= batch_limit_) flush();
  }

  /// Welds the corners that still wait. Throws Error{TooLarge}.
  void flush();

 private:
  [[nodiscard]] std::size_t vertex_count() const { return positions_.size() / 3; }
  [[nodiscard]] Point vertex(std::uint32_t id) const;
  void sort_batch();
  void match_groups();
  void number_corners();
  void merge_new_vertices();

  std::vector<Real>& positions_;
  std::vector<std::uint32_t>& corners_;
  std::string file_;
  std::vector<std::uint32_t> sorted_vertices_;  // all vertices, by position

  std::vector<Point> batch_;
  std::size_t batch_limit_ = std::size_t{1} << 16;
  std::vector<std::uint32_t> sorted_batch_;  // places in the batch, by position and then by place
  std::vector<std::uint32_t> first_;         // by place in the batch: the first place of equal position
  std::vector<std::uint32_t> id_;            // by place in the batch: the vertex
  std::vector<std::uint32_t> new_;           // first places of positions that no vertex had, by position
};

extern template class VertexWelder<float>;
extern template class VertexWelder<double>;

}  // namespace meshhood::io
