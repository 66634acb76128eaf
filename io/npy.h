// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The header of a `.npy` file: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html.
namespace meshhood::inline v0_1::io {

/// The type of the values as NumPy writes it: '<f4'.
template <class T>
[[nodiscard]] std::string npy_type() {
  const char order = sizeof(T) == 1 ? '|' : std::endian::native == std::endian::little ? '<' : '>';
  const char kind = std::is_same_v<T, bool> ? 'b' : std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
  return {order, kind, static_cast<char>('0' + sizeof(T))};
}

/// The bytes before the values, of version 1.0. `shape` is a tuple of Python: "(12,)".
[[nodiscard]] std::string npy_header(std::string_view type, std::string_view shape);

/// The contents of the header of a file.
struct NpyHeader {
  std::size_t bytes = 0;  ///< of the header; the values follow
  char kind = 'f';        ///< 'f', 'i', 'u', ...
  std::size_t item = 0;   ///< bytes of a value
  std::endian order = std::endian::little;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

/// The number of bytes in which the header of an array without fields ends.
inline constexpr std::size_t kNpyHeadBytes = 4096;

/// Whether a file that begins with `first_bytes` is meant to be a `.npy` file.
[[nodiscard]] bool is_npy(std::string_view first_bytes);

/// Reads a header of version 1, 2 or 3. `first_bytes`: the first `kNpyHeadBytes` of the file, or all. `file` is the
/// name in messages. Throws Error{MalformedFile, UnsupportedFormat}.
[[nodiscard]] NpyHeader parse_npy_header(std::string_view first_bytes, const std::string& file);

}  // namespace meshhood::inline v0_1::io
