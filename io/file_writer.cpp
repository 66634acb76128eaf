// SPDX-License-Identifier: MIT
#include "io/file_writer.h"

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "meshhood/error.h"

#include "io/place.h"
#include "io/uninterrupted.h"

namespace meshhood::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr mode_t kNewFileMode = 0666;  // less what the umask takes away
constexpr mode_t kPrivateMode = 0600;

// What a symbolic link stands for, so that the link survives; even if nothing is there yet.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code failed;
  auto target = std::filesystem::canonical(path, failed);
  if (!failed) return target;
  const auto missing = std::filesystem::read_symlink(path, failed);
  return failed ? path : path.parent_path() / missing;
}

// Recognisable as a leftover, should the process be killed. No longer than a name may be, though the target's may be
// so.
std::string temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial = 0;
  constexpr std::size_t kMost = 200;
  return fmt::format(".{}.meshhood-{}-{}.tmp", target.filename().string().substr(0, kMost), ::getpid(), serial++);
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = uninterrupted([&] { return ::write(file, bytes.data(), bytes.size()); });
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) : name_(path), target_(resolved(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (is_special) {
    open_in_place();
  } else {
    // What replaces a file that others may not read they may not read while it is written either.
    open_beside(std::filesystem::exists(status) ? kPrivateMode : kNewFileMode);
  }
}

void FileWriter::open_in_place() {
  file_ = Descriptor(uninterrupted([&] { return ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY); }));
  if (!file_.is_open()) fail("open");
}

void FileWriter::open_beside(mode_t mode) {
  for (;;) {
    auto name = target_.parent_path() / temporary_name(target_);
    constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    const int file = uninterrupted([&] { return ::open(name.c_str(), kFlags, mode); });
    if (file >= 0) {
      file_ = Descriptor(file);
      temporary_ = std::move(name);  // a copy could fail, and leave the file behind
      return;
    }
    if (errno != EEXIST) fail("create");
  }
}

FileWriter::~FileWriter() {
  if (temporary_.empty()) return;
  static_cast<void>(uninterrupted([this] { return ::unlink(temporary_.c_str()); }));
}

void FileWriter::write(std::string_view bytes) {
  if (bytes.size() >= kBufferBytes) {
    // Gains nothing from being copied.
    flush();
    write_through(bytes);
    return;
  }
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void FileWriter::write_through(std::string_view bytes) {
  if (!write_all(file_.number(), bytes)) fail("write");
  flushed_ += bytes.size();
}

void FileWriter::flush() {
  write_through(buffer_);
  buffer_.clear();
}

void FileWriter::seek(std::uint64_t position) {
  flush();
  const auto offset = static_cast<off_t>(position);
  if (uninterrupted([&] { return ::lseek(file_.number(), offset, SEEK_SET); }) < 0) fail("move within");
  flushed_ = position;
}

void FileWriter::commit(const std::function<void()>& last_chance) {
  flush();
  if (temporary_.empty()) {
    last_chance();
    if (!file_.close()) fail("close");
    return;
  }
  keep_owner_and_mode();
  const Descriptor directory = open_directory();
  if (uninterrupted([this] { return ::fsync(file_.number()); }) != 0) fail("sync");
  if (!file_.close()) fail("close");
  last_chance();
  if (uninterrupted([this] { return ::rename(temporary_.c_str(), target_.c_str()); }) != 0) fail("rename");
  temporary_.clear();
  sync(directory);
}

// A file that is replaced keeps its permissions, and its owner where we may give files away.
void FileWriter::keep_owner_and_mode() const {
  struct stat old = {};
  if (uninterrupted([&] { return ::stat(target_.c_str(), &old); }) != 0) {
    if (errno == ENOENT) return;
    fail("look at");
  }
  // Owner first, for a change of owner may take permissions away.
  const int given = uninterrupted([&] { return ::fchown(file_.number(), old.st_uid, old.st_gid); });
  if (given != 0 && errno != EPERM && errno != EINVAL) fail("set its owner");
  if (uninterrupted([&] { return ::fchmod(file_.number(), old.st_mode & 07777U); }) != 0) fail("set its mode");
}

// Opened before the rename, so that an error finds the old file in place. None where we may write to it but not read
// it: all that is lost is the promise for a loss of power.
Descriptor FileWriter::open_directory() const {
  const auto directory = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  const int file = uninterrupted([&] { return ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (file < 0 && errno != EACCES) fail("open its folder");
  return Descriptor(file);
}

// Not every file system has a notion of it.
void FileWriter::sync(const Descriptor& directory) const {
  if (!directory.is_open() || uninterrupted([&] { return ::fsync(directory.number()); }) == 0) return;
  if (errno != EINVAL && errno != ENOTSUP) fail("sync its folder (the new file is in place)");
}

void FileWriter::fail(std::string_view action) const {
  const auto reason = std::generic_category().message(errno);
  raise(ErrorCode::IoFailure, fmt::format("{}: cannot {}: {}", printable_name(name_.string()), action, reason));
}

}  // namespace meshhood::io
