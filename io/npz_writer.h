// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/npy.h"
#include "io/zip_writer.h"

namespace meshhood::inline v0_1::io {

/// Writes named arrays to a file for `numpy.load`, atomically (see `FileWriter`). All errors are Error{IoFailure}.
class NpzWriter {
 public:
  explicit NpzWriter(const std::filesystem::path& path) : zip_(path) {}

  /// Begins a one-dimensional array; exactly `count` values must follow by `append`.
  template <class T>
  void begin(std::string_view name, std::uint64_t count) {
    begin<T>(name, std::span<const std::uint64_t>(&count, 1));
  }

  /// The same for an array of several dimensions, whose values follow row by row.
  template <class T>
  void begin(std::string_view name, std::span<const std::uint64_t> shape) {
    begin_array(name, npy_type<T>(), shape, sizeof(T));
  }

  template <class T>
  void append(std::span<const T> values) {
    write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }

  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    begin<T>(name, values.size());
    append(values);
  }

  /// The same from numbers of another type.
  template <class T, class Numbers>
  void add_converted(std::string_view name, const Numbers& numbers) {
    add<T>(name, std::vector<T>(numbers.begin(), numbers.end()));
  }

  /// Adds an array of `count` values true, which is compressed. Other values are stored, as numbers hardly compress.
  void add_ones(std::string_view name, std::uint64_t count);

  /// Adds an ASCII string as an array without dimensions.
  void add_text(std::string_view name, std::string_view text);

  /// Adds ASCII strings as a one-dimensional array of strings.
  void add_texts(std::string_view name, std::span<const std::string> texts);

  /// Call it once, last.
  void commit();

 private:
  void begin_array(std::string_view name, std::string_view type, std::span<const std::uint64_t> shape,
                   std::size_t item);
  void begin_member(std::string_view name, std::string_view type, std::string_view shape, std::uint64_t bytes);
  void write(std::string_view bytes);

  ZipWriter zip_;
  std::uint64_t bytes_left_ = 0;  // of the current array
};

}  // namespace meshhood::inline v0_1::io
