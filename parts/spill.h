// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "parts/random_file.h"

namespace meshhood::parts {

/// Lists of records in temporary files, one for each list, to which records are appended in any order of the lists. A
/// record is a value of a type that is copied byte by byte. Memory: `buffer_bytes`, or 64 bytes a list if that is more.
/// No file stays open, so there may be any number of lists.
///
/// All errors are Error{IoFailure} with the path.
class Spill {
 public:
  /// `name`: the files are FOLDER/NAME-0, FOLDER/NAME-1, ...
  Spill(std::filesystem::path folder, std::string name, std::size_t lists, std::size_t buffer_bytes);

  template <class Record>
  void append(std::size_t list, const Record& record) {
    append_all(list, std::span(&record, 1));
  }

  template <class Record>
  void append_all(std::size_t list, std::span<const Record> records) {
    static_assert(std::is_trivially_copyable_v<Record>);
    append_bytes(list, {reinterpret_cast<const char*>(records.data()), records.size_bytes()});
  }

  /// Writes what is buffered. To be called before reading.
  void flush();

  /// The number of bytes of a list.
  [[nodiscard]] std::uint64_t size(std::size_t list) const { return sizes_[list]; }

  [[nodiscard]] std::filesystem::path file(std::size_t list) const;

 private:
  void append_bytes(std::size_t list, std::string_view bytes);
  void write(std::size_t list);

  std::filesystem::path folder_;
  std::string name_;
  std::size_t buffer_bytes_;  // of each list
  std::vector<std::string> buffers_;
  std::vector<std::uint64_t> sizes_;
};

/// Reads the records of a list in order.
class SpillReader {
 public:
  SpillReader(const Spill& spill, std::size_t list, std::size_t buffer_bytes)
      : path_(spill.file(list)), left_(spill.size(list)), buffer_bytes_(buffer_bytes) {}

  /// Reads the next record, which is as long as the one that was appended; false at the end. The buffer must have room
  /// for it.
  template <class Record>
  [[nodiscard]] bool next(Record& record) {
    static_assert(std::is_trivially_copyable_v<Record>);
    if (buffer_.size() - taken_ < sizeof(record)) fill();
    if (buffer_.size() == taken_) return false;
    assert(buffer_.size() - taken_ >= sizeof(record));
    std::memcpy(&record, buffer_.data() + taken_, sizeof(record));
    taken_ += sizeof(record);
    return true;
  }

 private:
  void fill();

  std::filesystem::path path_;
  std::uint64_t offset_ = 0;  // of the next byte to read from the file
  std::uint64_t left_;        // bytes of the file not yet read
  std::size_t buffer_bytes_;
  std::string buffer_;
  std::size_t taken_ = 0;
};

}  // namespace meshhood::parts
