// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/system_calls.h"

/// What a disk may hold after a loss of power, as cruel as file systems are allowed to be.
namespace meshhood::test {

/// Files and their names, as calls have left them.
///
/// What was written to a file is certain once the file was synced. Until then each page of 4 KiB has by itself come as
/// far as any of the writes to it, or not been written at all; a file may be as short as it was, or have grown without
/// its data, which then is zero. What a name stands for is certain once the folder was synced. Until then it is
/// anything it has stood for since, whether or not that file was synced.
class DiskModel {
 public:
  static constexpr std::size_t kPage = 4096;

  /// There has been such a file for long.
  void put(const std::string& path, std::string content);

  void apply(const Effect& effect);

  /// Calls `f(content)` for what may stand under `path` if the power fails now: null for no file. Of a file that was
  /// not synced: cut off or torn at every write and half-way through it, with every page missing, with every page
  /// alone, and with 100 random sets of pages.
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
    std::vector<Write> writes = {};  // since then
  };

  struct Open {
    std::string path;
    std::optional<FileId> file;  // none of a folder
    std::size_t position = 0;
  };

  class Survivors;

  [[nodiscard]] std::optional<FileId> find(const std::string& path) const;
  void open(const Effect& effect);
  void write(const Effect& effect);
  void sync(const Open& open);
  void let_stand_for(const std::string& path, std::optional<FileId> file);

  std::vector<File> files_;
  std::map<std::string, std::vector<std::optional<FileId>>> names_;  // what each has stood for; the last: now
  std::map<int, Open> open_;                                         // by the number of the file
};

}  // namespace meshhood::test
