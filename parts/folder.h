// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/messages.h"
#include "io/system.h"

/// What a run holds of the folder into which it writes, and what it may remove there. Errors of the system are
/// Error{IoFailure} or `filesystem_error`.
namespace meshhood::parts {

inline constexpr std::string_view kTemporaryFolder = ".partition.tmp";

/// The mark of a folder that was empty when a partition began: an empty file. There, the manifest, the parts and the
/// temporary folder are those of partitions; what is beside them stays.
inline constexpr std::string_view kMarkFile = ".partition";

void mark_folder(const std::filesystem::path& folder);

/// Throws Error{MalformedIndex} if the folder, which is locked, has files but no mark.
void check_mark(const std::filesystem::path& folder);

/// Throws Error{MalformedIndex}, naming the file, if a part has one, or is one, that no partition has written.
void check_part(const std::filesystem::path& part);

/// Removes a part by way of the temporary folder: a run that is stopped leaves no half of it in its place.
void remove_part(const std::filesystem::path& part, const std::filesystem::path& temporary);

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
