// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace meshhood::test {

/// A file system in memory, mounted on a folder for this process alone, that can be made to be full.
class SmallDisk {
 public:
  /// None where this process may not mount one.
  [[nodiscard]] static std::unique_ptr<SmallDisk> mount(const std::filesystem::path& folder);

  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  static constexpr std::uint64_t kPage = 4096;

  /// Leaves room for so many more pages than there are in use.
  void leave_free(std::uint64_t pages) const;

 private:
  explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

}  // namespace meshhood::test
