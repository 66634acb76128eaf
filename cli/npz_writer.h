// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "zip_writer.h"

namespace meshhood::cli {

/// Arrays by name, in a file that `numpy.load` reads. It appears whole or not at all.
///
/// T: bool, std::int32_t, std::int64_t, std::uint64_t or double. All errors are Error{IoFailure}.
class NpzWriter {
 public:
  explicit NpzWriter(const std::filesystem::path& path) : zip_(path) {}

  /// Begins an array of one dimension; `count` values in all are to follow by `append`.
  template <class T>
  void begin(std::string_view name, std::uint64_t count);

  template <class T>
  void append(std::span<const T> values);

  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    begin<T>(name, values.size());
    append(values);
  }

  /// A single text of ASCII: an array without dimensions.
  void add_text(std::string_view name, std::string_view text);

  /// To be called once, last.
  void commit();

 private:
  void begin_member(std::string_view name, std::string_view type, std::string_view shape, std::uint64_t bytes,
                    ZipWriter::Packing packing);

  ZipWriter zip_;
  std::uint64_t bytes_left_ = 0;  // of the array begun last
};

}  // namespace meshhood::cli
