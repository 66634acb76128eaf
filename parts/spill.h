// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "parts/random_file.h"

namespace meshhood::parts {

/// Lists of 64-bit words in temporary files, one for each list, to which words are appended in any order of the lists.
/// Memory: `buffer_bytes`, or 64 bytes a list if that is more. No file stays open, so there may be any number of lists.
///
/// All errors are Error{IoFailure} with the path.
class Spill {
 public:
  /// `name`: the files are FOLDER/NAME-0, FOLDER/NAME-1, ...
  Spill(std::filesystem::path folder, std::string name, std::size_t lists, std::size_t buffer_bytes);

  void append(std::size_t list, std::span<const std::uint64_t> words);

  /// Writes what is buffered. To be called before reading.
  void flush();

  /// The number of words of a list.
  [[nodiscard]] std::uint64_t size(std::size_t list) const { return sizes_[list]; }

  [[nodiscard]] std::filesystem::path file(std::size_t list) const;

 private:
  void write(std::size_t list);

  std::filesystem::path folder_;
  std::string name_;
  std::size_t buffer_words_;
  std::vector<std::vector<std::uint64_t>> buffers_;
  std::vector<std::uint64_t> sizes_;
};

/// Reads the words of a list in order.
class SpillReader {
 public:
  SpillReader(const Spill& spill, std::size_t list, std::size_t buffer_bytes)
      : path_(spill.file(list)), left_(spill.size(list)), buffer_words_(buffer_bytes / sizeof(std::uint64_t)) {}

  /// The next `count` words; empty at the end. Valid until the next call. `count` is at most the size of the buffer,
  /// and a list ends with a whole record.
  [[nodiscard]] std::span<const std::uint64_t> next(std::size_t count);

 private:
  void fill();

  std::filesystem::path path_;
  std::uint64_t offset_ = 0;  // of the next word to read from the file
  std::uint64_t left_;        // words of the file not yet read
  std::size_t buffer_words_;
  std::vector<std::uint64_t> buffer_;
  std::size_t taken_ = 0;
};

}  // namespace meshhood::parts
