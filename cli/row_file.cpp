// SPDX-License-Identifier: MIT
#include "row_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace meshhood::cli {
namespace {

bool is_matrix(RowOrder order) { return order != RowOrder::Index; }

/// The values of a matrix of ones.
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

}  // namespace

bool fits_32_bits(std::uint64_t count, std::uint64_t columns) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  return count <= kMost && columns <= kMost;
}

void begin_rows(io::NpzWriter& npz, RowOrder order, std::uint64_t rows, std::uint64_t columns) {
  if (!is_matrix(order)) return;
  const std::array<std::int64_t, 2> shape{static_cast<std::int64_t>(rows), static_cast<std::int64_t>(columns)};
  npz.add_text("format", "csr");
  npz.add<std::int64_t>("shape", shape);
}

std::string_view distances_name(RowOrder order) { return is_matrix(order) ? "data" : "distances"; }

void end_rows(io::NpzWriter& npz, RowOrder order, std::uint64_t count) {
  if (is_matrix(order)) write_ones(npz, count);
}

}  // namespace meshhood::cli
