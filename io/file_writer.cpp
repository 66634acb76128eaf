// SPDX-License-Identifier: MIT
#include "io/file_writer.h"

#include <atomic>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "meshhood/error.h"

#include "io/place.h"

namespace meshhood::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr mode_t kNewFileMode = 0666;  // less what the umask takes away

// What a symbolic link stands for, so that the link survives.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code ignored;
  auto target = std::filesystem::canonical(path, ignored);
  return ignored ? path : target;
}

// Recognisable as a leftover, should the process be killed.
std::string temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial = 0;
  return fmt::format(".{}.meshhood-{}-{}.tmp", target.filename().string(), ::getpid(), serial++);
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) : target_(resolved(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (is_special) {
    open_in_place();
  } else {
    open_beside();
  }
}

void FileWriter::open_in_place() {
  file_ = Descriptor(::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (!file_.is_open()) fail("open");
}

void FileWriter::open_beside() {
  for (;;) {
    const auto name = target_.parent_path() / temporary_name(target_);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
    if (file >= 0) {
      file_ = Descriptor(file);
      temporary_ = name;
      return;
    }
    if (errno != EEXIST) fail("create");
  }
}

FileWriter::~FileWriter() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileWriter::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void FileWriter::flush() {
  if (!write_all(file_.number(), buffer_)) fail("write");
  flushed_ += buffer_.size();
  buffer_.clear();
}

void FileWriter::seek(std::uint64_t position) {
  flush();
  if (::lseek(file_.number(), static_cast<off_t>(position), SEEK_SET) < 0) fail("move within");
  flushed_ = position;
}

void FileWriter::commit() {
  flush();
  if (temporary_.empty()) {
    if (!file_.close()) fail("close");
    return;
  }
  keep_mode();
  if (::fsync(file_.number()) != 0) fail("write");
  if (!file_.close()) fail("close");
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename");
  temporary_.clear();
  sync_directory();
}

// A file that is replaced keeps its permissions.
void FileWriter::keep_mode() const {
  struct stat status = {};
  if (::stat(target_.c_str(), &status) != 0) return;
  if (::fchmod(file_.number(), status.st_mode & 07777U) != 0) fail("set the mode of");
}

// The file is in place; where a directory cannot be synced, all that is lost is the promise for a power failure.
void FileWriter::sync_directory() const {
  const auto directory = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  const Descriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.is_open()) ::fsync(opened.number());
}

void FileWriter::fail(std::string_view action) const {
  const auto reason = std::generic_category().message(errno);
  raise(ErrorCode::IoFailure, fmt::format("{}: cannot {}: {}", printable_name(target_.string()), action, reason));
}

}  // namespace meshhood::io
