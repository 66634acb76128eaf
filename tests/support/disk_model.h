// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/system_calls.h"

/// The possible states of a disk after a loss of power, by the weakest guarantees that file systems give.
namespace meshhood::test {

/// Files and their names after a sequence of calls.
///
/// Data is durable once the file was synced. Until then each page of 4 KiB holds, independently of the others, its
/// state after any of the writes to it or before all of them; the file may have its old size, or the new size with
/// zeros in place of the data. The file of a name is durable once the folder was synced. Until then the name may refer
/// to any file it has referred to since the last sync, whether or not that file was synced.
class DiskModel {
 public:
  static constexpr std::size_t kPage = 4096;

  /// Adds a file that is already durable.
  void put(const std::string& path, std::string content);

  void apply(const Effect& effect);

  /// Calls `f(content)` for each possible content of `path` if the power fails now; null means no file. A file that was
  /// not synced is cut off at every write and in the middle of it, and has each page missing, each page alone, and
  /// 100 random sets of pages.
  void for_each_survivor(const std::string& path, const std::function<void(const std::string*)>& f) const;

 private:
  using FileId = std::size_t;

  struct Write {
    std::size_t position;
    std::string bytes;

    [[nodiscard]] std::size_t end() const { return position + bytes.size(); }
  };

  struct File {
    std::string synced;
    std::vector<Write> writes = {};  // since the last sync
  };

  struct Open {
    std::string path;
    std::optional<FileId> file;  // empty for a folder
    std::size_t position = 0;
  };

  class Survivors;

  [[nodiscard]] std::optional<FileId> find(const std::string& path) const;
  void open(const Effect& effect);
  void write(const Effect& effect);
  void sync(const Open& open);
  void let_stand_for(const std::string& path, std::optional<FileId> file);

  std::vector<File> files_;
  std::map<std::string, std::vector<std::optional<FileId>>>
      names_;                 // the files of each name; the last is the present one
  std::map<int, Open> open_;  // by file descriptor
};

}  // namespace meshhood::test
