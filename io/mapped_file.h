// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <span>

#include "io/messages.h"
#include "io/system.h"

namespace meshhood::inline v0_1::io {

/// A file mapped into memory, read-only. The file may be replaced by renaming, but must not be truncated or changed.
///
/// All errors are Error{IoFailure} with the path and errno.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path) {
    const Descriptor file = open_to_read(path);
    const FileStatus status = status_of(file, path);
    if (status.kind != FileStatus::Kind::Regular) raise_io(path, EINVAL, "cannot be mapped, expected a regular file");
    if (status.size == 0) return;
    bytes_ = map(file, static_cast<std::size_t>(status.size));
    if (bytes_.empty()) raise_errno(path, errno, "map");
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile() {
    if (!bytes_.empty()) unmap(bytes_);
  }

  /// The whole file; page-aligned.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace meshhood::inline v0_1::io
