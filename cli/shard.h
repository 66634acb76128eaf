// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace meshhood::cli {

/// One of several pieces of the rows of a batch, each of which a process computes: piece `number` of `count`, from 1.
struct Shard {
  std::uint64_t number = 1;
  std::uint64_t count = 1;

  /// The rows of the piece, of `rows` in all. The sizes of the pieces differ by one at most.
  [[nodiscard]] std::size_t first_row(std::size_t rows) const { return row(rows, number - 1); }
  [[nodiscard]] std::size_t end_row(std::size_t rows) const { return row(rows, number); }

 private:
  [[nodiscard]] std::size_t row(std::size_t rows, std::uint64_t piece) const {
    return static_cast<std::size_t>(rows / count * piece + rows % count * piece / count);
  }
};

/// Reads "3/32", or "slurm/32" with the number in the environment variable SLURM_ARRAY_TASK_ID.
/// Throws Error{InvalidOption}.
[[nodiscard]] Shard parse_shard(const std::string& text);

/// The name of the array in which a file of a batch describes its shard. Files of the same batch have the same text,
/// except for the number of the shard.
inline constexpr const char* kShardArray = "shard";

}  // namespace meshhood::cli
