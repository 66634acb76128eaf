// SPDX-License-Identifier: MIT
#include "io/mapped_file.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <sys/mman.h>
#include <sys/stat.h>

#include "meshhood/error.h"

#include "io/descriptor.h"
#include "io/place.h"

namespace meshhood::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  raise(ErrorCode::IoFailure, printable_name(path.string()) + ": " + reason);
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const Descriptor file = open_to_read(path);
  struct stat status = {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) fail(path, std::generic_category().message(errno));
  if (!S_ISREG(status.st_mode)) fail(path, "cannot be mapped, expected an ordinary file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (address == MAP_FAILED) fail(path, "cannot map: " + std::generic_category().message(errno));
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace meshhood::io
