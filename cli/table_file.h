// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "io/file_writer.h"

/// The file of an answer that is a table: arrays, or text that R, pandas and awk read.
namespace meshhood::cli {

struct TableFile {
  std::string name;         ///< "" if none was requested
  bool is_printed = false;  ///< by --csv, on standard output

  /// Whether it is text: by its extension, or printed.
  [[nodiscard]] bool is_csv() const;
};

/// --output, of `extension` (".npz") or .csv, and --csv, which prints the table instead.
void add_table_output(CLI::App& command, const std::string& extension, const std::string& description, TableFile& file);

/// The size of an answer.
struct AnswerSize {
  std::size_t rows = 0;
  std::uint64_t count = 0;  ///< of vertices in all rows
};

/// Throws Error{TooLarge} if `bytes`, the size of the file `output` for an answer of `size`, exceeds what the user says
/// or else the free space of its disk, unless that is unknown. `about` is for the message: "at least " for a lower
/// bound.
void check_size(const std::string& output, std::optional<std::uint64_t> max_bytes, const AnswerSize& size, double bytes,
                std::string_view about = "");

/// The names of a table with a line for each vertex of an answer.
[[nodiscard]] std::vector<std::string> pair_names(bool distances);

/// Writes a table as text, atomically (see `io::FileWriter`): a line of names, then a line for each row, with commas
/// between the numbers. A number has the fewest digits that read back as the same number; the others are NaN, Inf and
/// -Inf, as R spells them and pandas and NumPy accept them.
class CsvWriter {
 public:
  /// `max_bytes`: of the file. All functions throw Error{IoFailure}.
  CsvWriter(const std::string& file, const std::vector<std::string>& names,
            std::optional<std::uint64_t> max_bytes = std::nullopt);

  void add(double number);
  void add(std::integral auto number) { add_text(std::to_string(number)); }

  /// Throws Error{TooLarge} beyond `max_bytes`.
  void end_row();

  /// Call it once, last.
  void commit() { writer_.commit(); }

 private:
  void add_text(const std::string& text);

  io::FileWriter writer_;
  std::string file_;
  std::string line_;
  std::optional<std::uint64_t> max_bytes_;
};

}  // namespace meshhood::cli
