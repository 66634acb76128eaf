// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "meshhood/error.h"

/// How errors and warnings name the file, the place in it and what stands there.
namespace meshhood::io {

/// A line and column, both from 1, of a text, or a byte of a binary file.
struct Place {
  std::uint64_t line = 0;  ///< 0 where the place is a byte
  std::uint64_t column = 0;
  std::uint64_t byte = 0;

  /// What follows the name of the file in an error: ":12:7" or "@1048621".
  [[nodiscard]] std::string suffix() const;

  /// "line 12" or "byte 1048621".
  [[nodiscard]] std::string in_words() const;
};

/// Throws Error{code} with the message after the file and the place.
[[noreturn]] void fail_at(const std::string& file, const Place& place, ErrorCode code, std::string_view message);

/// A file's name for a message: control codes written as `\xNN`, so that no name breaks a message in two lines.
[[nodiscard]] std::string printable_name(std::string_view name);

/// The first 64 bytes of a file's text, all that is not printable ASCII written as `\xNN`: no file writes to the
/// terminal through us. "..." stands for what was cut.
[[nodiscard]] std::string escape(std::string_view text);

/// The same between quotation marks.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace meshhood::io
