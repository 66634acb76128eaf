// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "io/descriptor.h"

namespace meshhood::parts {

/// A regular file, read at any place. It is not mapped: mapped pages would count as memory of the process, and a file
/// truncated meanwhile would end it.
///
/// All errors are Error{IoFailure} with the path.
class RandomFile {
 public:
  explicit RandomFile(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Fills `out` with the bytes from `offset` on. They must lie in the file.
  void read(std::uint64_t offset, std::span<char> out) const;

 private:
  std::filesystem::path path_;
  io::Descriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace meshhood::parts
