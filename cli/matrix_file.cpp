// SPDX-License-Identifier: MIT
#include "matrix_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace meshhood::cli {

bool fits_32_bits(std::uint64_t count, std::uint64_t columns) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  return count <= kMost && columns <= kMost;
}

void begin_matrix(io::NpzWriter& npz, std::uint64_t rows, std::uint64_t columns) {
  const std::array<std::int64_t, 2> shape{static_cast<std::int64_t>(rows), static_cast<std::int64_t>(columns)};
  npz.add_text("format", "csr");
  npz.add<std::int64_t>("shape", shape);
}

void write_ones(io::NpzWriter& npz, std::uint64_t count) {
  constexpr auto kOnes = [] {
    std::array<bool, std::size_t{1} << 16> ones{};
    ones.fill(true);
    return ones;
  }();
  npz.begin<bool>("data", count);
  for (std::uint64_t left = count; left > 0;) {
    const auto ones = std::span(kOnes).first(static_cast<std::size_t>(std::min<std::uint64_t>(left, kOnes.size())));
    npz.append<bool>(ones);
    left -= ones.size();
  }
}

}  // namespace meshhood::cli
