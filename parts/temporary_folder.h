// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <system_error>
#include <utility>

#include "io/messages.h"
#include "io/system.h"

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
  ~TemporaryFolder() { io::remove_folder(path_); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace meshhood::parts
