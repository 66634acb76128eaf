// SPDX-License-Identifier: MIT
#include "support/small_disk.h"

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <sched.h>
#include <sys/mount.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace meshhood::test {
namespace {

bool write_text(const char* path, const std::string& text) {
  std::ofstream file(path);
  return (file << text << std::flush).good();
}

// Without root rights, a user namespace gives them if the system allows it.
bool enter_namespace() {
  const std::string user = "0 " + std::to_string(::getuid()) + " 1";
  const std::string group = "0 " + std::to_string(::getgid()) + " 1";
  if (::unshare(CLONE_NEWNS) == 0) return true;
  return ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 && write_text("/proc/self/setgroups", "deny") &&
         write_text("/proc/self/uid_map", user) && write_text("/proc/self/gid_map", group);
}

constexpr const char* kLarge = "size=64m";

}  // namespace

std::unique_ptr<SmallDisk> SmallDisk::mount(const std::filesystem::path& folder) {
  if (!enter_namespace()) return nullptr;
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return nullptr;
  if (::mount("none", folder.c_str(), "tmpfs", 0, kLarge) != 0) return nullptr;
  return std::unique_ptr<SmallDisk>(new SmallDisk(folder));
}

SmallDisk::~SmallDisk() { ::umount2(folder_.c_str(), MNT_DETACH); }

void SmallDisk::leave_free(std::uint64_t pages) const {
  struct statvfs status = {};
  if (::statvfs(folder_.c_str(), &status) != 0) throw std::system_error(errno, std::generic_category());
  const std::uint64_t used = (status.f_blocks - status.f_bfree) * status.f_frsize;
  const std::string size = "size=" + std::to_string(used + pages * kPage);
  if (::mount("none", folder_.c_str(), "tmpfs", MS_REMOUNT, size.c_str()) != 0) {
    throw std::system_error(errno, std::generic_category(), size);
  }
}

}  // namespace meshhood::test
