// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

namespace meshhood::test {

/// A file system in memory that can be filled, mounted on a folder for this process alone.
class SmallDisk {
 public:
  /// Empty if this process may not mount one.
  [[nodiscard]] static std::unique_ptr<SmallDisk> mount(const std::filesystem::path& folder);

  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  static constexpr std::uint64_t kPage = 4096;

  /// Limits the free space to this number of pages.
  void leave_free(std::uint64_t pages) const;

 private:
  explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace meshhood::test
