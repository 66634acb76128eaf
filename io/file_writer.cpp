// SPDX-License-Identifier: MIT
#include "io/file_writer.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "io/messages.h"
#include "io/waiting.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

bool is_read_only(const std::filesystem::path& file, std::filesystem::perms mode) {
  using std::filesystem::perms;
  constexpr perms kWrite = perms::owner_write | perms::group_write | perms::others_write;
  return (mode & kWrite) == perms::none || !may_write(file);
}

// Recognisable as a leftover if the process is killed. Short enough even if the name of the target has maximal length.
std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial = 0;
  constexpr std::size_t kMost = 200;
  std::filesystem::path name = ".";
  name += target.filename().native().substr(0, kMost);
  name += fmt::format(".meshhood-{}-{}.tmp", process_number(), serial++);
  return name;
}

bool is_special(const std::filesystem::file_status& status) {
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

std::filesystem::path written_file(std::filesystem::path path) {
  std::error_code failed;
  if (path == kStandardOutput || is_special(std::filesystem::status(path, failed))) return path;
  auto target = std::filesystem::canonical(path, failed);
  if (!failed) return target;
  constexpr int kMostLinks = 40;  // as Linux follows
  for (int i = 0; i < kMostLinks; ++i) {
    const auto next = std::filesystem::read_symlink(path, failed);
    if (failed) break;
    path = path.parent_path() / next;
  }
  return path;
}

FileWriter::FileWriter(const std::filesystem::path& path, Order order) : name_(path), target_(written_file(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  if (is_special(status) || target_ == kStandardOutput) {
    open_in_place(order);
  } else if (std::filesystem::exists(status) && is_read_only(target_, status.permissions())) {
    raise_io(name_, EACCES, "is read-only, expected a file that may be written");
  } else {
    // Create the temporary file private if it replaces a file, so that a private file is never briefly readable.
    open_beside(std::filesystem::exists(status));
  }
}

void FileWriter::open_in_place(Order order) {
  file_ = target_ == kStandardOutput ? duplicate(kOutputNumber) : open_special();
  if (!file_.is_open()) fail("open");
  is_regular_ = status_of(file_, name_).kind == FileStatus::Kind::Regular;
  if (order == Order::Any && !can_seek()) {
    stream_ = std::move(file_);
    file_ = create_unnamed();
    is_regular_ = true;
  }
}

Descriptor FileWriter::open_special() const {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    Descriptor file = open_to_write(target_);
    if (file.is_open() || errno != ENXIO) return file;
    if (std::chrono::steady_clock::now() - start >= kPartnerTimeout) {
      raise_io(name_, ETIMEDOUT, "no process reads this pipe");
    }
    report_wait();
    std::this_thread::sleep_for(kPollInterval);
  }
}

/// Offsets count from the start of a file, where standard output need not be.
bool FileWriter::can_seek() const {
  if (target_ == kStandardOutput) return false;
  if (move_to(file_, 0)) return true;
  if (errno != ESPIPE) fail("move within");
  return false;
}

void FileWriter::open_beside(bool is_private) {
  for (;;) {
    auto name = target_.parent_path() / temporary_name(target_);
    file_ = create(name, is_private);
    if (file_.is_open()) {
      temporary_ = std::move(name);  // a copy could fail, and leave the file behind
      return;
    }
    if (errno != EEXIST) fail("create");
  }
}

FileWriter::~FileWriter() {
  if (temporary_.empty()) return;
  static_cast<void>(file_.close());  // first: Windows removes no open file
  remove_file(temporary_);
}

void FileWriter::write(std::string_view bytes) {
  if (bytes.size() >= kBufferBytes) {
    flush();  // large enough to write without the copy into the buffer
    write_through(bytes);
    return;
  }
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void FileWriter::write_through(std::string_view bytes) {
  const bool is_written = is_regular_ ? write_all(file_, bytes) : write_when_ready(file_, bytes);
  if (!is_written) fail(stream_.is_open() ? "write its temporary file" : "write");
  flushed_ += bytes.size();
}

void FileWriter::flush() {
  write_through(buffer_);
  buffer_.clear();
}

void FileWriter::seek(std::uint64_t position) {
  flush();
  if (!move_to(file_, position)) fail("move within");
  flushed_ = position;
}

void FileWriter::copy_to_stream() {
  seek(0);
  const Descriptor unnamed = std::exchange(file_, std::move(stream_));
  is_regular_ = status_of(file_, name_).kind == FileStatus::Kind::Regular;
  std::string piece(kBufferBytes, '\0');
  for (;;) {
    const std::ptrdiff_t count = uninterrupted([&] { return read_some(unnamed, piece); });
    if (count < 0) fail("read its temporary file");
    if (count == 0) return;
    write_through(std::string_view(piece).substr(0, static_cast<std::size_t>(count)));
  }
}

void FileWriter::commit(const std::function<void()>& before_rename) {
  flush();
  if (stream_.is_open()) copy_to_stream();
  if (temporary_.empty()) {
    if (before_rename) before_rename();
    if (!file_.close()) fail("close");
    return;
  }
  if (const auto failed = take_owner_and_mode(file_, target_); !failed.empty()) fail(failed);
  const Descriptor directory = open_directory();
  if (!sync(file_)) fail("sync");
  if (!file_.close()) fail("close");
  if (before_rename) before_rename();
  if (!move_over(temporary_, target_)) fail("rename");
  temporary_.clear();
  sync_names(directory);
}

// Opened before the rename, so that on an error the old file is still in place. Not opened where the folder is writable
// but not readable: then the new file may not survive a loss of power.
Descriptor FileWriter::open_directory() const {
  Descriptor directory = open_folder(target_.has_parent_path() ? target_.parent_path() : std::filesystem::path("."));
  if (!directory.is_open() && errno != EACCES) fail("open its folder");
  return directory;
}

// Not every file system supports it.
void FileWriter::sync_names(const Descriptor& directory) const {
  if (!directory.is_open() || sync(directory)) return;
  if (errno != EINVAL && errno != ENOTSUP) fail("sync its folder (the new file is in place)");
}

void FileWriter::fail(std::string_view action) const { raise_errno(name_, errno, action); }

}  // namespace meshhood::inline v0_1::io
