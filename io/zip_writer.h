// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_writer.h"

namespace meshhood::inline v0_1::io {

/// Writes a zip file atomically (see `FileWriter`), with members of any size. The same members give the same bytes: all
/// have the date 1980-01-01, the first that the format can represent. Sizes and offsets from 2^32 - 1 are in the fields
/// of Zip64.
///
/// All errors are Error{IoFailure} with the path.
class ZipWriter {
 public:
  explicit ZipWriter(const std::filesystem::path& path);

  /// Ends the current member and begins the next, of `bytes` bytes that are stored as they are.
  void begin(const std::string& name, std::uint64_t bytes);

  void write(std::string_view bytes);

  /// Ends the current member and adds a compressed one: `head`, of less than 64 KiB, then `count` times `byte`, which
  /// is less than 144. 258 repeated bytes take 13 bits.
  void add_run(const std::string& name, std::string_view head, char byte, std::uint64_t count);

  /// Ends the last member and renames the file to the target. Call it once, last.
  void commit();

 private:
  struct Member {
    std::string name;
    std::uint64_t offset = 0;  // of its header
    std::uint64_t bytes = 0;
    std::uint64_t packed = 0;
    std::uint32_t checksum = 0;
    std::uint16_t method = 0;
  };

  static std::string header(const Member& member, bool is_central);
  static std::string end(std::uint64_t members, std::uint64_t offset, std::uint64_t bytes);
  void begin(Member member);
  void end_member();

  FileWriter file_;
  std::vector<Member> members_;  // the last may be incomplete
};

}  // namespace meshhood::inline v0_1::io
