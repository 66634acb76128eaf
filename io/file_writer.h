// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "io/system.h"

namespace meshhood::inline v0_1::io {

/// The file that a `FileWriter` writes: the end of a chain of symbolic links, even if it does not exist yet. Of a pipe
/// or a device it is `path` itself, because a link in /dev/fd to a pipe has no target that could be opened by name.
[[nodiscard]] std::filesystem::path written_file(std::filesystem::path path);

/// Writes a file atomically: to a temporary file beside the target, `.NAME.meshhood-PID-N.tmp`, which is renamed to the
/// target by `commit`. If the process is killed, the temporary file remains. Standard output, and a target that is not
/// a regular file (a pipe, a device), are written directly, and wait for their readers as `WhileWaiting` says; a named
/// pipe that no process opens to read within two seconds is refused. So is a file that is read-only. Links are followed
/// to their end.
///
/// All errors are Error{IoFailure} with the path and errno, also a file-size limit (EFBIG; no SIGXFSZ reaches the
/// process). A file is then unchanged, as it is when memory runs out. One error comes after the rename and says so:
/// if the folder cannot be synced, the new file is in place but might not survive a loss of power.
class FileWriter {
 public:
  /// The order of the bytes. In any order, what goes to a pipe or to standard output is first written to a temporary
  /// file without a name.
  enum class Order { Sequential, Any };

  explicit FileWriter(const std::filesystem::path& path, Order order = Order::Sequential);
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Removes the temporary file, unless it was committed.
  ~FileWriter();

  void write(std::string_view bytes);

  /// The offset of the next byte.
  [[nodiscard]] std::uint64_t position() const { return flushed_ + buffer_.size(); }

  /// Moves to another offset, to overwrite the bytes there. Only with `Order::Any`.
  void seek(std::uint64_t position);

  /// Syncs the file and renames it to the target. Call it once, last. `before_rename` is called when the data is on the
  /// disk; if it throws, the target is unchanged.
  void commit(const std::function<void()>& before_rename = {});

 private:
  void open_in_place(Order order);
  [[nodiscard]] Descriptor open_special() const;
  [[nodiscard]] bool can_seek() const;
  void open_beside(bool is_private);
  void write_through(std::string_view bytes);
  void flush();
  void copy_to_stream();
  [[nodiscard]] Descriptor open_directory() const;
  void sync_names(const Descriptor& directory) const;
  [[noreturn]] void fail(std::string_view action) const;

  std::filesystem::path name_;  // as given, for messages
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty if the target is written directly
  Descriptor file_;
  Descriptor stream_;       // while `file_` has no name: what it will be copied to
  bool is_regular_ = true;  // `file_`; else a write may wait for a reader
  std::string buffer_;
  std::uint64_t flushed_ = 0;  // offset of the buffer in the file
};

}  // namespace meshhood::inline v0_1::io
