// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <ftw.h>
#include <sys/stat.h>

#include "io/messages.h"

namespace meshhood::parts {

/// A folder for temporary files, removed with its content. A folder that a killed run has left is emptied first.
/// Throws Error{IoFailure}.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    if (!error) std::filesystem::create_directory(path_, error);
    if (error) io::raise_errno(path_, error.value(), "create");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// Not by `std::filesystem::remove_all`, which throws if memory runs out.
  ~TemporaryFolder() {
    constexpr int kOpenFolders = 4;
    const auto remove = [](const char* file, const struct stat*, int, FTW*) { return std::remove(file); };
    static_cast<void>(::nftw(path_.c_str(), remove, kOpenFolders, FTW_DEPTH | FTW_PHYS));
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace meshhood::parts
