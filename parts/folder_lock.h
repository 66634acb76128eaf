// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>

#include "io/messages.h"
#include "io/system.h"

namespace meshhood::parts {

/// An exclusive lock of a folder, so that one run at a time writes into it. The system releases it when the process
/// ends in any way, and no file remains.
/// Throws Error{IoFailure} with EWOULDBLOCK if another run has it.
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

  /// Writes the names in the folder to the disk. Throws Error{IoFailure}.
  void sync() const {
    if (!io::sync(folder_)) io::raise_errno(path_, errno, "sync");
  }

 private:
  std::filesystem::path path_;
  io::Descriptor folder_;
};

}  // namespace meshhood::parts
