// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/run.h"

/// How errors and warnings name a file, a location in it and what was found there.
namespace meshhood::inline v0_1::io {

/// A line and column of a text, both from 1, or a byte of a binary file.
struct Location {
  std::uint64_t line = 0;  ///< 0 for a binary file
  std::uint64_t column = 0;
  std::uint64_t byte = 0;

  /// The text after the name of the file in an error: ":12:7" or "@1048621".
  [[nodiscard]] std::string suffix() const;

  /// "line 12" or "byte 1048621".
  [[nodiscard]] std::string in_words() const;
};

/// Throws Error{code}: "FILE:12:7: message". `file` is printable.
[[noreturn]] void fail_at(const std::string& file, const Location& location, ErrorCode code, std::string_view message);

/// Throws Error{IoFailure} with the path and the `errno` value (0 for none): "PATH: message".
[[noreturn]] void raise_io(const std::filesystem::path& path, int error_number, std::string_view message);

/// The same: "PATH: No such file or directory", or "PATH: cannot ACTION: No such file or directory".
[[noreturn]] void raise_errno(const std::filesystem::path& path, int error_number, std::string_view action = {});

/// Calls `progress` if it is set. Throws Error{Cancelled}, naming the file, if it returns false.
void report(const Progress& progress, std::size_t done, std::size_t total, const std::string& file);

/// The same for a file, row after row.
class RowProgress {
 public:
  /// Borrows `progress`.
  RowProgress(const Progress& progress, std::size_t total, std::string file)
      : progress_(progress), file_(std::move(file)), total_(total) {}

  void report() const { io::report(progress_, done_, total_, file_); }

  void add_row() {
    constexpr std::size_t kRows = 4096;
    if (++done_ % kRows == 0) report();
  }

 private:
  const Progress& progress_;
  std::string file_;
  std::size_t total_;
  std::size_t done_ = 0;
};

/// A file name for a message, on one line and safe for a terminal: control characters (C0, C1, line separators,
/// changes of the writing direction) and bytes that are not UTF-8 are written as `\xNN`.
[[nodiscard]] std::string printable_name(std::string_view name);

/// At most 64 bytes of a file's text; all that is not printable ASCII is written as `\xNN`, and "..." marks a cut.
[[nodiscard]] std::string escape(std::string_view text);

/// The same between quotation marks.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace meshhood::inline v0_1::io
