// SPDX-License-Identifier: MIT
#include "parts/random_file.h"

#include <cerrno>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/descriptor.h"
#include "io/messages.h"

namespace meshhood::parts {

RandomFile::RandomFile(const std::filesystem::path& path) : path_(path), file_(io::open_to_read(path)) {
  struct stat status = {};
  if (!file_.is_open() || ::fstat(file_.number(), &status) != 0) io::raise_errno(path, errno);
  if (!S_ISREG(status.st_mode)) io::raise_io(path, EINVAL, "is not a regular file, which is read several times");
  size_ = static_cast<std::uint64_t>(status.st_size);
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
