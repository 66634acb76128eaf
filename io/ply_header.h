// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/input_buffer.h"
#include "io/messages.h"

/// The header of a PLY file.
namespace meshhood::inline v0_1::io {

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Of the bytes of a number.
[[nodiscard]] inline std::endian order_of(PlyEncoding encoding) {
  return encoding == PlyEncoding::BigEndian ? std::endian::big : std::endian::little;
}

/// Calls `f` with a value of the C++ type of `type`.
template <class F>
decltype(auto) with_type(PlyType type, F&& f) {
  switch (type) {
    case PlyType::Int8: return f(std::int8_t{});
    case PlyType::Uint8: return f(std::uint8_t{});
    case PlyType::Int16: return f(std::int16_t{});
    case PlyType::Uint16: return f(std::uint16_t{});
    case PlyType::Int32: return f(std::int32_t{});
    case PlyType::Uint32: return f(std::uint32_t{});
    case PlyType::Float32: return f(float{});
    case PlyType::Float64: break;
  }
  return f(double{});
}

/// In bytes, in a binary file.
[[nodiscard]] inline std::size_t size_of(PlyType type) {
  return with_type(type, [](auto example) { return sizeof(example); });
}

[[nodiscard]] inline bool is_integer(PlyType type) { return type != PlyType::Float32 && type != PlyType::Float64; }

/// Of an integer type.
[[nodiscard]] inline bool is_signed(PlyType type) {
  return type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32;
}

/// The largest value of an integer type.
[[nodiscard]] inline std::uint64_t largest(PlyType type) {
  return (std::uint64_t{1} << (8 * size_of(type) - (is_signed(type) ? 1 : 0))) - 1;
}

/// Whether float represents every value of the type.
[[nodiscard]] inline bool fits_float(PlyType type) { return size_of(type) <= 2 || type == PlyType::Float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;  ///< of the value, or of the values of a list
  bool is_list = false;
  PlyType count_type = PlyType::Uint8;  ///< of the length of a list; an integer type
};

/// Whether none is a list.
[[nodiscard]] inline bool are_single(std::span<const PlyProperty> properties) {
  return std::ranges::none_of(properties, &PlyProperty::is_list);
}

/// In a binary file, of properties that are single.
[[nodiscard]] inline std::size_t bytes_of(std::span<const PlyProperty> properties) {
  std::size_t sum = 0;
  for (const PlyProperty& property : properties) sum += size_of(property.type);
  return sum;
}

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
  Location location;  ///< of its count in the header

  /// Whether faces or strips have their corners there.
  [[nodiscard]] bool has_corners(const PlyProperty& property) const {
    const bool is_kept = name == "face" || name == "tristrips";
    return is_kept && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  /// The places of the properties for which `is_it` holds.
  template <class Predicate>
  [[nodiscard]] std::vector<std::size_t> find(Predicate&& is_it) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (is_it(properties[i])) found.push_back(i);
    }
    return found;
  }
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;  ///< names are unique
  std::uint64_t lines = 0;
};

/// Leaves `input` at the first byte of the values. All header lines end as the first one, with CR, LF or CRLF; exactly
/// one line end after `end_header` belongs to the header.
///
/// Throws Error{MalformedFile, UnsupportedFormat}.
[[nodiscard]] PlyHeader read_ply_header(InputBuffer& input);

}  // namespace meshhood::inline v0_1::io
