// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "io/mesh_builder.h"
#include "shared/distance.h"

/// Plain rows of a binary PLY file in the byte order of the processor. Both functions take rows from the front of
/// `bytes` as long as they are complete and valid, into an array that they replace, and return how many bytes they
/// took.
namespace meshhood::io {

/// Rows of `stride` bytes, with coordinates of the type `Real` at `offsets`.
template <class Real>
[[nodiscard]] std::size_t take_vertices(std::string_view bytes, std::size_t stride,
                                        const std::array<std::size_t, 3>& offsets, std::uint64_t most,
                                        std::vector<Real>& positions) {
  const auto rows = static_cast<std::size_t>(std::min<std::uint64_t>(most, bytes.size() / stride));
  positions.resize(3 * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    bool are_valid = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Real& coordinate = positions[3 * row + axis];
      std::memcpy(&coordinate, bytes.data() + row * stride + offsets[axis], sizeof(Real));
      are_valid = are_valid && double{std::abs(coordinate)} <= kLargestCoordinate;
    }
    if (!are_valid) {
      positions.resize(3 * row);
      return row * stride;
    }
  }
  return rows * stride;
}

/// Rows of a byte, which is `count`, and as many indices of 32 bits, each smaller than `end`. A `count` known to the
/// compiler is faster.
template <class Count>
[[nodiscard]] std::size_t take_faces(std::string_view bytes, Count count, std::uint32_t end, std::uint64_t most,
                                     std::vector<std::uint32_t>& corners) {
  const std::size_t stride = 1 + sizeof(std::uint32_t) * std::size_t{count};
  const auto rows = static_cast<std::size_t>(std::min<std::uint64_t>(most, bytes.size() / stride));
  corners.resize(rows * count);
  std::size_t row = 0;
  for (; row < rows; ++row) {
    const char* const from = bytes.data() + row * stride;
    if (static_cast<unsigned char>(*from) != count) break;
    std::uint32_t* const to = corners.data() + row * count;
    if (count != 0) std::memcpy(to, from + 1, stride - 1);
    if (std::any_of(to, to + count, [end](std::uint32_t index) { return index >= end; })) break;
  }
  corners.resize(row * count);
  return row * stride;
}

}  // namespace meshhood::io
