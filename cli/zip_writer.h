// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace meshhood::cli {

/// A zip file that appears whole or not at all (see `io::FileWriter`), member after member, each of any size. The same
/// members make the same bytes: all are dated 1980-01-01, where the time of a zip file begins.
///
/// All errors are Error{IoFailure} and name the path and the reason.
class ZipWriter {
 public:
  enum class Packing { Stored, Deflated };

  explicit ZipWriter(const std::filesystem::path& path);
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// Removes what was written, unless it was committed.
  ~ZipWriter();

  /// Ends the member before and begins the next, of `bytes` bytes.
  void begin(const std::string& name, std::uint64_t bytes, Packing packing);

  void write(std::string_view bytes);

  /// Ends the last member and puts the file into its place. To be called once, last.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meshhood::cli
