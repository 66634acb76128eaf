// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "meshhood/run.h"

#include "io/system.h"

namespace meshhood::inline v0_1::io {

/// A sequence of bytes to read once.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  /// The total number of bytes, if it is known in advance: not for a pipe or a device.
  [[nodiscard]] virtual std::optional<std::uint64_t> size() const = 0;

  /// Fills the front of `out`, at most 4 MB of it, and returns the number of bytes; 0 only at the end.
  [[nodiscard]] std::size_t read(std::span<char> out);

  /// Fills `out` unless the source ends before. Returns the number of bytes.
  [[nodiscard]] std::size_t fill(std::span<char> out);

  /// From now on, progress in bytes is reported before each read; the total is 0 if the size is unknown. Borrows
  /// `progress`. `name` is the file in the message if it cancels: then these functions throw
  /// Error{Cancelled}.
  void watch(const Progress& progress, std::string name);

  /// Reports the bytes read so far.
  void report() const;

  /// Reports the total, even if the reader did not need all bytes.
  void finish();

 private:
  /// As `read`, of any number of bytes.
  [[nodiscard]] virtual std::size_t take(std::span<char> out) = 0;

  const Progress* progress_ = nullptr;
  std::string watched_name_;
  std::uint64_t done_ = 0;
};

/// Bytes in memory, borrowed.
class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes), left_(bytes) {}

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return bytes_.size(); }

 private:
  [[nodiscard]] std::size_t take(std::span<char> out) override;

  std::span<const std::byte> bytes_;
  std::span<const std::byte> left_;
};

/// A file, pipe or device, read in one pass. Waits for others as `WhileWaiting` says; a named pipe that no process
/// opens to write within two seconds is refused. All errors are Error{IoFailure}, naming the path.
class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path);

  /// A regular file that is open already, from its first byte on. `path` is for messages.
  FileSource(const std::filesystem::path& path, Descriptor file);

  [[nodiscard]] std::optional<std::uint64_t> size() const override { return size_; }

  /// The first bytes of the file, `count` of them unless it has fewer. To be called before `read`, which returns them
  /// again.
  [[nodiscard]] std::string_view peek(std::size_t count);

  /// Whether it is neither a pipe nor a device, nor standard input, which can be read once.
  [[nodiscard]] bool is_regular() const { return is_regular_; }

 private:
  [[nodiscard]] std::size_t take(std::span<char> out) override;
  [[nodiscard]] std::size_t read_file(std::span<char> out);

  std::filesystem::path path_;
  Descriptor file_;
  std::string peeked_;  // not yet returned by `read`
  std::optional<std::uint64_t> size_;
  bool is_regular_ = false;
  bool may_lack_a_writer_ = false;
  bool may_block_ = false;
};

}  // namespace meshhood::inline v0_1::io
