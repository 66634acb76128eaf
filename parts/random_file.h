// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "io/byte_source.h"
#include "io/system.h"

namespace meshhood::parts {

/// A regular file, read at any place. It is not mapped: mapped pages would count as memory of the process, and a file
/// truncated meanwhile would end it.
///
/// All errors are Error{IoFailure} with the path.
class RandomFile {
 public:
  explicit RandomFile(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return opened_.size; }

  /// Fills `out` with the bytes from `offset` on. They must lie in the file.
  void read(std::uint64_t offset, std::span<char> out) const;

  /// The same open file, to be read in order. Only one such source at a time.
  [[nodiscard]] io::FileSource in_order() const { return {path_, io::duplicate(file_.number())}; }

  /// Refuses a file that has been written to since it was opened.
  void check_unchanged() const;

 private:
  std::filesystem::path path_;
  io::Descriptor file_;
  io::FileStatus opened_;  // when it was opened
};

}  // namespace meshhood::parts
