// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "io/descriptor.h"
#include "io/messages.h"

namespace meshhood::parts {

/// An exclusive lock of a folder, so that one run at a time writes into it. The system releases it when the process
/// ends in any way, and no file remains.
/// Throws Error{IoFailure} with EWOULDBLOCK if another run has it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : path_(folder),
        folder_(io::uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); })) {
    if (!folder_.is_open()) io::raise_errno(folder, errno, "open");
    if (io::uninterrupted([&] { return ::flock(folder_.number(), LOCK_EX | LOCK_NB); }) == 0) return;
    if (errno != EWOULDBLOCK) io::raise_errno(folder, errno, "lock");
    io::raise_io(folder, EWOULDBLOCK, "another run writes into this folder");
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Unlocks explicitly: if the file were only closed, a child that was forked meanwhile would keep the lock.
  ~FolderLock() { static_cast<void>(::flock(folder_.number(), LOCK_UN)); }

  /// Writes the names in the folder to the disk. Throws Error{IoFailure}.
  void sync() const {
    if (io::uninterrupted([&] { return ::fsync(folder_.number()); }) != 0) io::raise_errno(path_, errno, "sync");
  }

 private:
  std::filesystem::path path_;
  io::Descriptor folder_;
};

}  // namespace meshhood::parts
