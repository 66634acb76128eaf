// SPDX-License-Identifier: MIT
#include "io/mapped_file.h"

#include <cerrno>
#include <cstddef>

#include "io/messages.h"
#include "io/system.h"

namespace meshhood::inline v0_1::io {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const Descriptor file = open_to_read(path);
  const FileStatus status = status_of(file, path);
  if (status.kind != FileStatus::Kind::Regular) raise_io(path, EINVAL, "cannot be mapped, expected a regular file");
  if (status.size == 0) return;
  bytes_ = map(file, static_cast<std::size_t>(status.size));
  if (bytes_.empty()) raise_errno(path, errno, "map");
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) unmap(bytes_);
}

}  // namespace meshhood::inline v0_1::io
