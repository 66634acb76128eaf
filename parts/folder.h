// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/messages.h"
#include "io/system.h"

/// What a run holds of the folder into which it writes, and what it may remove there: only what a run has written. All
/// errors are Error{IoFailure}, but where another is named.
namespace meshhood::parts {

inline constexpr std::string_view kTemporaryFolder = ".partition.tmp";

/// The number of the part whose folder has this name; nothing for every other name.
[[nodiscard]] std::optional<std::uint64_t> part_number(const std::filesystem::path& name);

/// Whether a part has its own record, which may be damaged after its beginning.
[[nodiscard]] bool has_record(const std::filesystem::path& part);

/// Throws Error{MalformedIndex}, naming the entry, if the manifest or the temporary folder was not written by a run.
/// What else is beside the parts stays as it is.
void check_folder(const std::filesystem::path& folder);

/// How many parts the manifest of a folder lists: 0 if it is damaged, or there is none.
[[nodiscard]] std::uint64_t listed_parts(const std::filesystem::path& folder);

/// Throws Error{MalformedIndex}, naming what is in the way, unless a run has written the folder of a part: it has only
/// files of a part, and its own record or a number below `listed`. It may be damaged or not exist.
void check_part(const std::filesystem::path& part, std::uint64_t listed);

/// Checks a part and removes it by way of the temporary folder: a run that is stopped leaves no half of it in its
/// place.
void remove_part(const std::filesystem::path& part, std::uint64_t listed, const std::filesystem::path& temporary);

/// An exclusive lock of a folder, so that one run at a time writes into it. The system releases it when the process
/// ends in any way, and no file remains. The error has EWOULDBLOCK if another run has it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder) : path_(folder), folder_(io::lock_folder(folder)) {
    if (folder_.is_open()) return;
    if (errno == EWOULDBLOCK) io::raise_io(folder, EWOULDBLOCK, "another run writes into this folder");
    io::raise_errno(folder, errno, "open and lock");
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { io::unlock(folder_); }

  /// Writes the names in the folder to the disk.
  void sync() const {
    if (!io::sync(folder_)) io::raise_errno(path_, errno, "sync");
  }

 private:
  std::filesystem::path path_;
  io::Descriptor folder_;
};

/// A folder for temporary files, removed with its content. A folder that a killed run has left is emptied first.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    if (!error) std::filesystem::create_directory(path_, error);
    if (error) io::raise_errno(path_, error.value(), "create");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { io::remove_folder(path_); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace meshhood::parts
