// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "io/npz_writer.h"

/// The arrays of a sparse matrix as `scipy.sparse.load_npz` reads them.
namespace meshhood::cli {

/// SciPy uses 32-bit indices where they suffice, and would convert others. `count`: of the stored values.
[[nodiscard]] bool fits_32_bits(std::uint64_t count, std::uint64_t columns);

/// Writes the format and the shape.
void begin_matrix(io::NpzWriter& npz, std::uint64_t rows, std::uint64_t columns);

/// Writes the values of a matrix of ones.
void write_ones(io::NpzWriter& npz, std::uint64_t count);

}  // namespace meshhood::cli
