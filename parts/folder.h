// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/messages.h"
#include "io/system.h"

/// What a run holds of the folder into which it writes. All errors are Error{IoFailure}.
namespace meshhood::parts {

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
