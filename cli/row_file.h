// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/npz_writer.h"
#include "names.h"

/// The arrays of the rows of a batch in a file.
///
/// In vertex order or in that of a list they are those of a sparse matrix that `scipy.sparse.load_npz` reads: `format`,
/// `shape`, `indptr`, `indices`, `data`; `vertices` has the list. Rows in index order are not stored as a matrix,
/// because SciPy would ignore `vertices` and take row `i` for that of vertex `i`. They are `vertices`, `indptr`,
/// `indices`, `distances`, and SciPy refuses them.
namespace meshhood::cli {

enum class RowOrder { Index, Vertex, List };

inline constexpr Names<RowOrder, 3> kRowOrders{
    {{"index", RowOrder::Index}, {"vertex", RowOrder::Vertex}, {"list", RowOrder::List}}};

/// Whether the array `vertices` says of which vertex a row is.
[[nodiscard]] constexpr bool has_vertices(RowOrder order) { return order != RowOrder::Vertex; }

/// SciPy uses 32-bit indices where they suffice, and would convert others. `count`: of the stored values.
[[nodiscard]] bool fits_32_bits(std::uint64_t count, std::uint64_t columns);

/// Writes what precedes `indptr`.
void begin_rows(io::NpzWriter& npz, RowOrder order, std::uint64_t rows, std::uint64_t columns);

/// The name of the array of distances.
[[nodiscard]] std::string_view distances_name(RowOrder order);

/// Writes what follows `indices` if there are no distances.
void end_rows(io::NpzWriter& npz, RowOrder order, std::uint64_t count);

}  // namespace meshhood::cli
