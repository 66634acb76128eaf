// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "io/input.h"
#include "io/mesh_builder.h"
#include "io/place.h"
#include "io/ply_header.h"

namespace meshhood::io {

/// Why a value was not taken.
using Problem = std::optional<std::string>;

/// The values of a PLY file, one after the other, be they text or bytes.
class PlyValues {
 public:
  PlyValues() = default;
  PlyValues(const PlyValues&) = delete;
  PlyValues& operator=(const PlyValues&) = delete;
  virtual ~PlyValues() = default;

  /// Appends the next value to `positions`.
  [[nodiscard]] virtual Problem take_coordinate(PlyType type, Positions& positions) = 0;

  /// Takes the next value, of an integer type, into `value`.
  [[nodiscard]] virtual Problem take_integer(PlyType type, std::int64_t& value) = 0;

  /// Passes over `count` values.
  [[nodiscard]] virtual Problem skip(PlyType type, std::uint64_t count) = 0;

  /// The least number of bytes that a value takes in the file.
  [[nodiscard]] virtual std::uint64_t least_bytes(PlyType type) const = 0;

  /// The number of bytes that values may still take, where it is known.
  [[nodiscard]] virtual std::optional<std::uint64_t> bytes_left() const = 0;

  /// Whether the row, already begun, certainly holds no further value.
  [[nodiscard]] virtual bool row_is_over() const = 0;

  /// Whether there is anything left; if so, it becomes the place.
  [[nodiscard]] virtual bool anything_left() = 0;

  /// Of the value taken last, or of the end of the file.
  [[nodiscard]] virtual Place place() const = 0;
};

/// The values behind a header that was read from `input`, which must outlive them.
[[nodiscard]] std::unique_ptr<PlyValues> ply_values(Input& input, const PlyHeader& header);

}  // namespace meshhood::io
