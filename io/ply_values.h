// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/input_buffer.h"
#include "io/mesh_builder.h"
#include "io/messages.h"
#include "io/ply_header.h"
#include "io/readers.h"

namespace meshhood::inline v0_1::io {

/// Why a value could not be read; empty if it could.
using Problem = std::optional<std::string>;

/// The problem of a file that is too short.
inline constexpr std::string_view kFileEnds = "the file ends here";

/// The problem of a line that is too short, in a file whose rows are lines.
inline constexpr std::string_view kLineEnds = "the line ends here";

/// The plain rows of an element of a PLY file (see `PlainRows`): takes some, up to `most`, and appends what they hold.
/// Returns how many there were: the next row, if there is one, is to be read value by value. Empty if none is plain.
using PlyRows = std::function<std::uint64_t(std::uint64_t most)>;

/// The values of a PLY file in order, from text or bytes.
class PlyValues {
 public:
  PlyValues() = default;
  PlyValues(const PlyValues&) = delete;
  PlyValues& operator=(const PlyValues&) = delete;
  virtual ~PlyValues() = default;

  /// Reads the next value and appends it to `positions`.
  [[nodiscard]] virtual Problem take_coordinate(PlyType type, Positions& positions) = 0;

  /// Reads the next value, of an integer type.
  [[nodiscard]] virtual Problem take_integer(PlyType type, std::int64_t& value) = 0;

  /// For the vertices, with the properties x, y, z at `axes`, and for the faces, with the vertices in the property
  /// `list` and every index below `vertices`. Both borrow their arguments.
  [[nodiscard]] virtual PlyRows vertex_rows(const PlyElement& element, const std::array<std::size_t, 3>& axes,
                                            Positions& positions) = 0;
  [[nodiscard]] virtual PlyRows face_rows(const PlyElement& element, std::size_t list, std::uint64_t vertices,
                                          Faces& faces) = 0;

  /// Skips `count` values.
  [[nodiscard]] virtual Problem skip(PlyType type, std::uint64_t count) = 0;

  /// The least number of bytes of a value in the file.
  [[nodiscard]] virtual std::uint64_t least_bytes(PlyType type) const = 0;

  /// The number of bytes left for values, if it is known.
  [[nodiscard]] virtual std::optional<std::uint64_t> bytes_left() const = 0;

  /// Whether the current row certainly has no further value.
  [[nodiscard]] virtual bool row_is_over() const = 0;

  /// To be called after the values of row `row` of `element`, which is in the header. Returns whether more numbers
  /// follow in the line, which are skipped. Throws Error{MalformedFile} if a row so far has too few numbers.
  [[nodiscard]] virtual bool end_row(const PlyElement& element, std::uint64_t row) = 0;

  /// "; vertex 0 runs on after line 12": the first row that is not a line, which may be the cause of an error. Empty if
  /// there is none.
  [[nodiscard]] virtual std::string hint() const = 0;

  /// Whether there is data left; if so, it becomes the location.
  [[nodiscard]] virtual bool anything_left() = 0;

  /// Of the last value, or of the end of the file.
  [[nodiscard]] virtual Location location() const = 0;
};

/// The values after a header that was read from `input`, in text or as bytes. Both must outlive them.
[[nodiscard]] std::unique_ptr<PlyValues> ply_text(InputBuffer& input, const PlyHeader& header,
                                                  const ReaderOptions& options);
[[nodiscard]] std::unique_ptr<PlyValues> ply_binary(InputBuffer& input, const PlyHeader& header,
                                                    const ReaderOptions& options);

[[nodiscard]] inline std::unique_ptr<PlyValues> ply_values(InputBuffer& input, const PlyHeader& header,
                                                           const ReaderOptions& options = {}) {
  return header.encoding == PlyEncoding::Ascii ? ply_text(input, header, options) : ply_binary(input, header, options);
}

}  // namespace meshhood::inline v0_1::io
