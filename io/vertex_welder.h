// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace meshhood::inline v0_1::io {

/// Merges all corners of equal position (-0 equals 0) into one vertex. Vertices are numbered in order of first
/// appearance.
///
/// Looks positions up in a hash table. Its hash differs from run to run, so that no file can be made that is slow to
/// weld; the result does not depend on it. O(n). Memory beside the result: 6 to 12 bytes for each vertex that there is
/// or is expected.
template <class Real>
class VertexWelder {
 public:
  using Point = std::array<Real, 3>;

  /// `positions` (#V by 3) and `corners` receive the result; both must be empty and outlive this. `file` is for
  /// messages.
  VertexWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& corners, std::string file);

  /// Makes the table large enough for so many vertices.
  void expect(std::size_t vertices);

  /// The coordinates are finite. Throws Error{TooLarge}.
  void append(const Point& corner) { corners_.push_back(vertex_at(corner)); }

 private:
  [[nodiscard]] std::size_t vertex_count() const { return positions_.size() / 3; }
  [[nodiscard]] Point vertex(std::uint32_t id) const;
  [[nodiscard]] std::size_t first_slot(const Point& point) const;
  [[nodiscard]] std::size_t next_slot(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  std::uint32_t vertex_at(const Point& point);
  std::uint32_t new_vertex(const Point& point);
  void resize(std::size_t slots);

  std::vector<Real>& positions_;
  std::vector<std::uint32_t>& corners_;
  std::string file_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> slots_;  // vertices; a power of two of them, at most two thirds of which are used
};

extern template class VertexWelder<float>;
extern template class VertexWelder<double>;

}  // namespace meshhood::inline v0_1::io
