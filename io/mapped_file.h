// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace meshhood::inline v0_1::io {

/// A file mapped into memory, read-only. The file may be replaced by renaming, but must not be truncated or changed.
///
/// All errors are Error{IoFailure} with the path and errno.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  /// The whole file; page-aligned.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace meshhood::inline v0_1::io
