// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include <sys/types.h>

#include "io/descriptor.h"

namespace meshhood::io {

/// Writes a file that appears whole or not at all: under another name beside the target, `.NAME.meshhood-PID-N.tmp`,
/// which takes its place on `commit`. Where the process is killed, that one stays behind. A target that is no ordinary
/// file (a pipe, a device) is written to directly.
///
/// All errors are Error{IoFailure} and name the path and the reason; the target is then as it was, as it is where
/// memory runs out. One error comes too late for that, and says so: where the folder cannot be synced, the new file is
/// in place, but might not outlive a loss of power.
class FileWriter {
 public:
  explicit FileWriter(const std::filesystem::path& path);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Removes what was written, unless it was committed.
  ~FileWriter();

  void write(std::string_view bytes);

  /// Where the next byte goes, counted from the beginning.
  [[nodiscard]] std::uint64_t position() const { return flushed_ + buffer_.size(); }

  /// Goes to another place, to write over what stands there. Not every target that is no ordinary file can do it.
  void seek(std::uint64_t position);

  /// Makes what was written durable and visible. To be called once, last. In between, once what was written is on the
  /// disk, `last_chance` is called, and may throw: then the target is as it was.
  void commit(const std::function<void()>& last_chance = [] {});

 private:
  void open_in_place();
  void open_beside(mode_t mode);
  void write_through(std::string_view bytes);
  void flush();
  void keep_owner_and_mode() const;
  [[nodiscard]] Descriptor open_directory() const;
  void sync(const Descriptor& directory) const;
  [[noreturn]] void fail(std::string_view action) const;

  std::filesystem::path name_;  // as it was given, for messages
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty where the target is written to directly
  Descriptor file_;
  std::string buffer_;
  std::uint64_t flushed_ = 0;  // where the buffer goes
};

}  // namespace meshhood::io
