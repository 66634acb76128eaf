// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/byte_source.h"

namespace meshhood::inline v0_1::io {

/// A file read through a window that moves forward. Only the window is in memory, because a text takes more memory than
/// the numbers it contains.
class InputBuffer {
 public:
  /// `name` is the file in messages. Throws Error{TooLarge} if the source declares, or turns out to have, more than
  /// `max_bytes`.
  InputBuffer(ByteSource& source, const std::string& name, std::uint64_t max_bytes);

  /// Printable.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// The size of the whole file, if it is known in advance.
  [[nodiscard]] std::optional<std::uint64_t> size() const { return source_.size(); }

  /// The number of bytes skipped so far: the offset of the window in the file.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

  /// The following bytes, as many as are in memory: at least `count` unless the file ends before. Valid until the next
  /// call.
  [[nodiscard]] std::string_view ahead(std::size_t count) {
    if (end_ - begin_ < count) fill(count);
    return {buffer_.get() + begin_, end_ - begin_};
  }

  /// Moves past `count` bytes that `ahead` has returned.
  void skip(std::size_t count) {
    begin_ += count;
    offset_ += count;
  }

  /// The number of bytes that follow, if it is known in advance.
  [[nodiscard]] std::optional<std::uint64_t> left() const;

 private:
  void fill(std::size_t count);
  void make_room(std::size_t count);
  void read_more();

  ByteSource& source_;
  std::string name_;
  std::uint64_t max_bytes_;
  std::unique_ptr<char[]> buffer_;  // NOLINT(modernize-avoid-c-arrays): a vector would initialize it
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
  bool exhausted_ = false;
};

}  // namespace meshhood::inline v0_1::io
