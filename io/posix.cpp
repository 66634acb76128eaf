// SPDX-License-Identifier: MIT
#include <algorithm>
#include <climits>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <ftw.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/messages.h"
#include "io/system.h"
#include "io/waiting.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr mode_t kSharedMode = 0666;  // reduced by the umask
constexpr mode_t kPrivateMode = 0600;

/// O_NONBLOCK, because the opening of a pipe without a partner would block.
constexpr int kWithoutWaiting = O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

Descriptor open_file(const std::filesystem::path& path, int flags, mode_t mode = 0) {
  return Descriptor(uninterrupted([&] { return ::open(path.c_str(), flags, mode); }));
}

/// macOS has another name for what POSIX calls `st_mtim`.
timespec written_at(const struct stat& status) {
#if defined(__APPLE__)
  return status.st_mtimespec;
#else
  return status.st_mtim;
#endif
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

}  // namespace

/// An interruption by a signal is none: Linux has released the descriptor by then, and a second close might hit a
/// file that another thread has opened since.
bool Descriptor::close() {
  const int number = std::exchange(number_, -1);
  return number < 0 || ::close(number) == 0 || errno == EINTR;
}

Descriptor duplicate(int number) { return Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, 0)); }

Descriptor open_to_read(const std::filesystem::path& path) {
  if (path == kStandardInput) return duplicate(kInputNumber);
  return open_file(path, O_RDONLY | kWithoutWaiting);
}

Descriptor open_to_write(const std::filesystem::path& path) { return open_file(path, O_WRONLY | kWithoutWaiting); }

Descriptor create(const std::filesystem::path& path, bool is_private) {
  return open_file(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, is_private ? kPrivateMode : kSharedMode);
}

Descriptor open_to_append(const std::filesystem::path& path) {
  return open_file(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kPrivateMode);
}

Descriptor create_unnamed() {
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  std::string name = (none ? std::filesystem::path(".") : folder) / ".meshhood-XXXXXX";
  Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (!file.is_open() || uninterrupted([&] { return ::unlink(name.c_str()); }) != 0) {
    raise_errno(name, errno, "create");
  }
  return file;
}

Descriptor open_folder(const std::filesystem::path& path) {
  return open_file(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

Descriptor lock_folder(const std::filesystem::path& path) {
  Descriptor folder = open_folder(path);
  if (folder.is_open() && uninterrupted([&] { return ::flock(folder.number(), LOCK_EX | LOCK_NB); }) != 0) {
    const int error = errno;
    static_cast<void>(folder.close());
    errno = error;
  }
  return folder;
}

/// If the file were only closed, a child that was forked meanwhile would keep the lock.
void unlock(const Descriptor& folder) { static_cast<void>(::flock(folder.number(), LOCK_UN)); }

FileStatus status_of(const Descriptor& file, const std::filesystem::path& path) {
  struct stat status = {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) raise_errno(path, errno);
  if (S_ISDIR(status.st_mode)) raise_io(path, EISDIR, "is a directory, expected a file");
  using Kind = FileStatus::Kind;
  const Kind kind = S_ISREG(status.st_mode) ? Kind::Regular : S_ISFIFO(status.st_mode) ? Kind::Pipe : Kind::Other;
  const timespec written = written_at(status);
  return {kind, static_cast<std::uint64_t>(status.st_size),
          static_cast<std::uint64_t>(written.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(written.tv_nsec)};
}

bool may_write(const std::filesystem::path& file) { return ::access(file.c_str(), W_OK) == 0 || errno != EACCES; }

bool may_create_in(const std::filesystem::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

std::ptrdiff_t read_some(const Descriptor& file, std::span<char> out) {
  return ::read(file.number(), out.data(), out.size());
}

std::ptrdiff_t read_some_at(const Descriptor& file, std::uint64_t offset, std::span<char> out) {
  return ::pread(file.number(), out.data(), out.size(), static_cast<off_t>(offset));
}

bool write_all(const Descriptor& file, std::string_view bytes) {
  const BlockedFileSizeSignal blocked;
  while (!bytes.empty()) {
    const ssize_t count = uninterrupted([&] { return ::write(file.number(), bytes.data(), bytes.size()); });
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// A pipe that has room takes PIPE_BUF bytes without waiting.
bool write_when_ready(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    wait_for(file, Ready::ToWrite, kNoTimeout);
    const ssize_t count = ::write(file.number(), bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
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

std::int64_t position_of(const Descriptor& file) { return ::lseek(file.number(), 0, SEEK_CUR); }

bool move_to(const Descriptor& file, std::uint64_t position) {
  return uninterrupted([&] { return ::lseek(file.number(), static_cast<off_t>(position), SEEK_SET); }) >= 0;
}

bool becomes_ready(const Descriptor& file, Ready ready, std::chrono::milliseconds limit) {
  pollfd waiting = {file.number(), static_cast<short>(ready == Ready::ToRead ? POLLIN : POLLOUT), 0};
  return ::poll(&waiting, 1, static_cast<int>(limit.count())) > 0;
}

bool sync(const Descriptor& file) {
  return uninterrupted([&] { return ::fsync(file.number()); }) == 0;
}

std::string_view take_owner_and_mode(const Descriptor& file, const std::filesystem::path& replaced) {
  struct stat old = {};
  if (uninterrupted([&] { return ::stat(replaced.c_str(), &old); }) != 0) return errno == ENOENT ? "" : "stat";
  // Owner first: a change of owner may remove permissions.
  const int given = uninterrupted([&] { return ::fchown(file.number(), old.st_uid, old.st_gid); });
  if (given != 0 && errno != EPERM && errno != EINVAL) return "set its owner";
  return uninterrupted([&] { return ::fchmod(file.number(), old.st_mode & 07777U); }) == 0 ? "" : "set its mode";
}

bool move_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  return uninterrupted([&] { return ::rename(from.c_str(), to.c_str()); }) == 0;
}

void remove_file(const std::filesystem::path& path) noexcept {
  static_cast<void>(uninterrupted([&] { return ::unlink(path.c_str()); }));
}

/// Not by `std::filesystem::remove_all`, which throws if memory runs out.
void remove_folder(const std::filesystem::path& path) noexcept {
  constexpr int kOpenFolders = 4;
  const auto remove = [](const char* file, const struct stat*, int, FTW*) { return std::remove(file); };
  static_cast<void>(::nftw(path.c_str(), remove, kOpenFolders, FTW_DEPTH | FTW_PHYS));
}

std::span<const std::byte> map(const Descriptor& file, std::size_t size) {
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (address == MAP_FAILED) return {};
  return {static_cast<const std::byte*>(address), size};
}

void unmap(std::span<const std::byte> bytes) { ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size()); }

long process_number() { return ::getpid(); }

}  // namespace meshhood::inline v0_1::io
