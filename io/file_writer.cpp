// SPDX-License-Identifier: MIT
#include "io/file_writer.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/descriptor.h"
#include "io/messages.h"
#include "io/waiting.h"

namespace meshhood::io {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr mode_t kNewFileMode = 0666;  // reduced by the umask
constexpr mode_t kPrivateMode = 0600;

// The target of a chain of symbolic links, even if it does not exist yet: the links are kept.
std::filesystem::path resolved(std::filesystem::path path) {
  if (path == kStandardOutput) return path;
  std::error_code failed;
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

bool is_read_only(const std::filesystem::path& file, std::filesystem::perms mode) {
  using std::filesystem::perms;
  constexpr perms kWrite = perms::owner_write | perms::group_write | perms::others_write;
  return (mode & kWrite) == perms::none || (::access(file.c_str(), W_OK) != 0 && errno == EACCES);
}

bool is_regular(const Descriptor& file) {
  struct stat status = {};
  return ::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode);
}

// Recognisable as a leftover if the process is killed. Short enough even if the name of the target has maximal length.
std::string temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> serial = 0;
  constexpr std::size_t kMost = 200;
  return fmt::format(".{}.meshhood-{}-{}.tmp", target.filename().string().substr(0, kMost), ::getpid(), serial++);
}

/// During its lifetime, a write beyond the file-size limit (`ulimit -f`) fails with EFBIG and does not raise SIGXFSZ,
/// which would end the process and leave the temporary file. The signal goes to the writing thread: it is blocked there
/// and removed, and the signal disposition of the process stays as it is.
class BlockedFileSizeSignal {
 public:
  BlockedFileSizeSignal() {
    sigemptyset(&signal_);  // without ::, as these may be macros
    sigaddset(&signal_, SIGXFSZ);
    was_pending_ = is_pending();
    ::pthread_sigmask(SIG_BLOCK, &signal_, &previous_mask_);
  }
  BlockedFileSizeSignal(const BlockedFileSizeSignal&) = delete;
  BlockedFileSizeSignal& operator=(const BlockedFileSizeSignal&) = delete;
  ~BlockedFileSizeSignal() {
    const int error = errno;
    int removed = 0;
    if (!was_pending_ && is_pending()) ::sigwait(&signal_, &removed);
    ::pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
    errno = error;
  }

 private:
  static bool is_pending() {
    sigset_t pending;
    ::sigpending(&pending);
    return sigismember(&pending, SIGXFSZ) == 1;
  }

  sigset_t signal_{};
  sigset_t previous_mask_{};
  bool was_pending_ = false;
};

bool write_all(int file, std::string_view bytes) {
  const BlockedFileSizeSignal blocked;
  while (!bytes.empty()) {
    const ssize_t count = uninterrupted([&] { return ::write(file, bytes.data(), bytes.size()); });
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// The same to a pipe, a terminal or a device. A pipe that has room takes PIPE_BUF bytes without waiting.
bool write_when_ready(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    wait_for(file, POLLOUT, kNoTimeout);
    const ssize_t count = ::write(file, bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EINTR) {
      report_wait();
    } else if (errno != EAGAIN) {
      return false;
    }
  }
  return true;
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path, Order order) : name_(path), target_(resolved(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(target_, ignored);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (is_special || target_ == kStandardOutput) {
    open_in_place(order);
  } else if (std::filesystem::exists(status) && is_read_only(target_, status.permissions())) {
    raise_io(name_, EACCES, "is read-only, expected a file that may be written");
  } else {
    // Create the temporary file private if it replaces a file, so that a private file is never briefly readable.
    open_beside(std::filesystem::exists(status) ? kPrivateMode : kNewFileMode);
  }
}

void FileWriter::open_in_place(Order order) {
  file_ = target_ == kStandardOutput ? duplicate(STDOUT_FILENO) : open_special();
  if (!file_.is_open()) fail("open");
  is_regular_ = is_regular(file_);
  if (order == Order::Any && !can_seek()) {
    stream_ = std::move(file_);
    open_unnamed();
    is_regular_ = true;
  }
}

/// O_NONBLOCK, because the opening of a pipe without a reader would block.
Descriptor FileWriter::open_special() const {
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    Descriptor file(
        uninterrupted([&] { return ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); }));
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
  if (uninterrupted([&] { return ::lseek(file_.number(), 0, SEEK_SET); }) == 0) return true;
  if (errno != ESPIPE) fail("move within");
  return false;
}

void FileWriter::open_unnamed() {
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  std::string name = (none ? std::filesystem::path(".") : folder) / ".meshhood-XXXXXX";
  file_ = Descriptor(::mkostemp(name.data(), O_CLOEXEC));
  if (!file_.is_open() || uninterrupted([&] { return ::unlink(name.c_str()); }) != 0) {
    raise_errno(name, errno, "create");
  }
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
    flush();  // large enough to write without the copy into the buffer
    write_through(bytes);
    return;
  }
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
}

void FileWriter::write_through(std::string_view bytes) {
  const bool is_written = is_regular_ ? write_all(file_.number(), bytes) : write_when_ready(file_.number(), bytes);
  if (!is_written) fail(stream_.is_open() ? "write its temporary file" : "write");
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

void FileWriter::copy_to_stream() {
  seek(0);
  const Descriptor unnamed = std::exchange(file_, std::move(stream_));
  is_regular_ = is_regular(file_);
  std::string piece(kBufferBytes, '\0');
  for (;;) {
    const ssize_t count = uninterrupted([&] { return ::read(unnamed.number(), piece.data(), piece.size()); });
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
  keep_owner_and_mode();
  const Descriptor directory = open_directory();
  if (uninterrupted([this] { return ::fsync(file_.number()); }) != 0) fail("sync");
  if (!file_.close()) fail("close");
  if (before_rename) before_rename();
  if (uninterrupted([this] { return ::rename(temporary_.c_str(), target_.c_str()); }) != 0) fail("rename");
  temporary_.clear();
  sync(directory);
}

// A replaced file keeps its permissions, and its owner where the process may change owners.
void FileWriter::keep_owner_and_mode() const {
  struct stat old = {};
  if (uninterrupted([&] { return ::stat(target_.c_str(), &old); }) != 0) {
    if (errno == ENOENT) return;
    fail("stat");
  }
  // Owner first: a change of owner may remove permissions.
  const int given = uninterrupted([&] { return ::fchown(file_.number(), old.st_uid, old.st_gid); });
  if (given != 0 && errno != EPERM && errno != EINVAL) fail("set its owner");
  if (uninterrupted([&] { return ::fchmod(file_.number(), old.st_mode & 07777U); }) != 0) fail("set its mode");
}

// Opened before the rename, so that on an error the old file is still in place. Not opened where the folder is writable
// but not readable: then the new file may not survive a loss of power.
Descriptor FileWriter::open_directory() const {
  const auto directory = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  const int file = uninterrupted([&] { return ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (file < 0 && errno != EACCES) fail("open its folder");
  return Descriptor(file);
}

// Not every file system supports it.
void FileWriter::sync(const Descriptor& directory) const {
  if (!directory.is_open() || uninterrupted([&] { return ::fsync(directory.number()); }) == 0) return;
  if (errno != EINVAL && errno != ENOTSUP) fail("sync its folder (the new file is in place)");
}

void FileWriter::fail(std::string_view action) const { raise_errno(name_, errno, action); }

}  // namespace meshhood::io
