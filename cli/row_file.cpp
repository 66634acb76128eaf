// SPDX-License-Identifier: MIT
#include "row_file.h"

#include <array>
#include <limits>

namespace meshhood::cli {
namespace {

bool is_matrix(RowOrder order) { return order != RowOrder::Index; }

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
  if (is_matrix(order)) npz.add_ones("data", count);
}

}  // namespace meshhood::cli
