// SPDX-License-Identifier: MIT
#include "parts/random_file.h"

#include <cerrno>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/descriptor.h"
#include "io/messages.h"

namespace meshhood::parts {
namespace {

/// macOS has another name for what POSIX calls `st_mtim`.
timespec written_at(const struct stat& status) {
#if defined(__APPLE__)
  return status.st_mtimespec;
#else
  return status.st_mtim;
#endif
}

}  // namespace

RandomFile::RandomFile(const std::filesystem::path& path) : path_(path), file_(io::open_to_read(path)) {
  const struct stat opened = status();
  if (!S_ISREG(opened.st_mode)) io::raise_io(path, EINVAL, "is not a regular file, which is read several times");
  size_ = static_cast<std::uint64_t>(opened.st_size);
  written_ = written_at(opened);
}

struct stat RandomFile::status() const {
  struct stat result = {};
  if (!file_.is_open() || ::fstat(file_.number(), &result) != 0) io::raise_errno(path_, errno);
  return result;
}

void RandomFile::check_unchanged() const {
  const struct stat now = status();
  const timespec written = written_at(now);
  const bool is_same = static_cast<std::uint64_t>(now.st_size) == size_ && written.tv_sec == written_.tv_sec &&
                       written.tv_nsec == written_.tv_nsec;
  if (!is_same) io::raise_io(path_, 0, "was written to while it was read, which takes several passes");
}

void RandomFile::read(std::uint64_t offset, std::span<char> out) const {
  while (!out.empty()) {
    const ssize_t count =
        io::uninterrupted([&] { return ::pread(file_.number(), out.data(), out.size(), static_cast<off_t>(offset)); });
    if (count < 0) io::raise_errno(path_, errno, "read");
    if (count == 0) {
      io::raise_io(path_, 0, fmt::format("the file ends at byte {}, but had {} bytes when opened", offset, size_));
    }
    offset += static_cast<std::uint64_t>(count);
    out = out.subspan(static_cast<std::size_t>(count));
  }
}

}  // namespace meshhood::parts
