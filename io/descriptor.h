// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/messages.h"

namespace meshhood::io {

/// Makes the system call `call()`, again if a signal interrupted it, and returns its result. Not for calls that wait
/// for another process (see waiting.h).
template <class F>
[[nodiscard]] auto uninterrupted(F&& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// An open file of the operating system, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    static_cast<void>(close());
    number_ = std::exchange(other.number_, -1);
    return *this;
  }
  ~Descriptor() { static_cast<void>(close()); }

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

  /// Closes the file and returns whether there was no error. An interruption by a signal is no error: Linux has
  /// released the descriptor by then, and a second close might hit a file that another thread has opened since.
  [[nodiscard]] bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0 || errno == EINTR;
  }

 private:
  int number_;
};

/// The names of the standard streams. A file of this name is the stream of the process itself: opened again, a socket
/// is refused, and a regular file begins at its start.
inline constexpr std::string_view kStandardInput = "/dev/stdin";
inline constexpr std::string_view kStandardOutput = "/dev/stdout";

/// Another descriptor of an open file, at the same place in it.
[[nodiscard]] inline Descriptor duplicate(int number) {
#if defined(F_DUPFD_CLOEXEC)
  return Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, 0));
#else
  errno = EBADF;  // WebAssembly, which opens no file
  static_cast<void>(number);
  return Descriptor();
#endif
}

/// Opens `path` for reading. O_NONBLOCK, because the opening of a pipe without a writer would block.
[[nodiscard]] inline Descriptor open_to_read(const std::filesystem::path& path) {
  if (path == kStandardInput) return duplicate(STDIN_FILENO);
  return Descriptor(uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); }));
}

/// The status of a file that has been opened. Throws Error{IoFailure} if that failed, and for a directory.
[[nodiscard]] inline struct stat status_of(const Descriptor& file, const std::filesystem::path& path) {
  struct stat status = {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) raise_errno(path, errno);
  if (S_ISDIR(status.st_mode)) raise_io(path, EISDIR, "is a directory, expected a file");
  return status;
}

}  // namespace meshhood::io
