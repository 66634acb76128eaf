// SPDX-License-Identifier: MIT
#include "io/mapped_file.h"

#include <cerrno>
#include <cstddef>

#include <sys/mman.h>
#include <sys/stat.h>

#include "io/descriptor.h"
#include "io/messages.h"

namespace meshhood::io {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const Descriptor file = open_to_read(path);
  const struct stat status = status_of(file, path);
  if (!S_ISREG(status.st_mode)) raise_io(path, EINVAL, "cannot be mapped, expected a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (address == MAP_FAILED) raise_errno(path, errno, "map");
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace meshhood::io
