// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace meshhood::io {

/// Merges all corners of equal position (-0 equals 0) into one vertex. Vertices are numbered in order of first
/// appearance.
///
/// Sorts instead of hashing, so that no file can be made that is slow to weld. Corners are welded in batches, so the
/// unwelded triangles are never in memory as a whole. Memory beside the result: 4 bytes per vertex, and at most 28 (for
/// double 40) per corner of a batch, which has an eighth as many corners as there are vertices. O(n log n).
template <class Real>
class VertexWelder {
 public:
  using Point = std::array<Real, 3>;

  /// `positions` (#V by 3) and `corners` receive the result; both must be empty and outlive this. `file` is for
  /// messages.
  VertexWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& corners, std::string file)
      : positions_(positions), corners_(corners), file_(std::move(file)) {}

  /// The coordinates are finite. Throws Error{TooLarge}.
  void append(const Point& corner) {
    batch_.push_back(corner);
    if (batch_.size() >= batch_limit_) flush();
  }

  /// Welds the remaining corners. Throws Error{TooLarge}.
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
  std::vector<std::uint32_t> sorted_batch_;  // indices into the batch, by position and then by index
  std::vector<std::uint32_t> first_;         // for each corner of the batch: the first corner of equal position
  std::vector<std::uint32_t> id_;            // for each corner of the batch: the vertex
  std::vector<std::uint32_t> new_;           // first corners at positions without a vertex, by position
};

extern template class VertexWelder<float>;
extern template class VertexWelder<double>;

}  // namespace meshhood::io
