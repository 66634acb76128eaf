// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace meshhood::io {

/// Writes a zip file atomically (see `FileWriter`), with members of any size. The same members give the same bytes: all
/// have the date 1980-01-01, the first that the format can represent.
///
/// All errors are Error{IoFailure} with the path.
class ZipWriter {
 public:
  enum class Packing { Stored, Deflated };

  explicit ZipWriter(const std::filesystem::path& path);
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// Removes the temporary file, unless it was committed.
  ~ZipWriter();

  /// Ends the current member and begins the next, of `bytes` bytes.
  void begin(const std::string& name, std::uint64_t bytes, Packing packing);

  void write(std::string_view bytes);

  /// Ends the last member and renames the file to the target. Call it once, last.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meshhood::io
