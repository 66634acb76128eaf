// SPDX-License-Identifier: MIT
#include "parts/random_file.h"

#include <cerrno>

#include <fmt/format.h>

#include "io/messages.h"

namespace meshhood::parts {
RandomFile::RandomFile(const std::filesystem::path& path)
    : path_(path), file_(io::open_to_read(path)), opened_(io::status_of(file_, path)) {
  if (opened_.kind != io::FileStatus::Kind::Regular) {
    io::raise_io(path, EINVAL, "is not a regular file, which is read several times");
  }
}

void RandomFile::check_unchanged() const {
  const io::FileStatus now = io::status_of(file_, path_);
  const bool is_same = now.size == opened_.size && now.written == opened_.written;
  if (!is_same) io::raise_io(path_, 0, "was written to while it was read, which takes several passes");
}

void RandomFile::read(std::uint64_t offset, std::span<char> out) const {
  while (!out.empty()) {
    const std::ptrdiff_t count = io::uninterrupted([&] { return io::read_some_at(file_, offset, out); });
    if (count < 0) io::raise_errno(path_, errno, "read");
    if (count == 0) {
      io::raise_io(path_, 0, fmt::format("the file ends at byte {}, but had {} bytes when opened", offset, size()));
    }
    offset += static_cast<std::uint64_t>(count);
    out = out.subspan(static_cast<std::size_t>(count));
  }
}

}  // namespace meshhood::parts
