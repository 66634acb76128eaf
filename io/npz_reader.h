// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/npy.h"

namespace meshhood::io {

/// Reads the arrays of an `.npz` file, one after the other, in pieces.
///
/// All errors are Error{IoFailure} with the path; Error{MalformedFile, UnsupportedFormat} from the header of an array.
class NpzReader {
 public:
  explicit NpzReader(const std::filesystem::path& path);
  NpzReader(NpzReader&&) noexcept;
  ~NpzReader();

  [[nodiscard]] bool has(std::string_view name) const;

  /// Begins an array. Throws Error{IoFailure} if the file has none of this name.
  NpyHeader begin(std::string_view name);

  /// The number of values that are left of the current array.
  [[nodiscard]] std::uint64_t left() const { return left_; }

  /// Replaces `values` by the next ones, at most a million; false at the end, where the checksum of the array has been
  /// verified. T: std::int64_t, for all integers, or double.
  template <class T>
  bool read(std::vector<T>& values);

  /// A whole array of integers.
  [[nodiscard]] std::vector<std::int64_t> integers(std::string_view name);

  /// The text of an array without dimensions, as `NpzWriter::add_text` writes it; at most 64 KiB.
  [[nodiscard]] std::string text(std::string_view name);

 private:
  void take(std::span<char> out);
  void end();
  [[noreturn]] void fail(std::string_view problem) const;

  struct Archive;
  std::unique_ptr<Archive> archive_;
  std::filesystem::path path_;
  std::string name_;  // of the current array
  NpyHeader header_;
  std::uint64_t left_ = 0;
};

}  // namespace meshhood::io
