// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

/// What mesh files and parts need of the operating system: by POSIX in posix.cpp, on Windows in windows.cpp.
///
/// A function that fails returns a closed descriptor, a negative number, false or an empty span, and sets `errno`,
/// unless it says that it throws.
namespace meshhood::inline v0_1::io {

/// Calls `call()` until no signal interrupts it, and returns its result. Not for calls that wait for another process
/// (see waiting.h).
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

  /// Closes the file and returns whether there was no error.
  [[nodiscard]] bool close();

 private:
  int number_;
};

/// The names of the standard streams. A file of this name is the stream of the process itself: opened again, a socket
/// is refused, and a regular file begins at its start.
inline constexpr std::string_view kStandardInput = "/dev/stdin";
inline constexpr std::string_view kStandardOutput = "/dev/stdout";
inline constexpr int kInputNumber = 0;
inline constexpr int kOutputNumber = 1;

/// Another descriptor of an open file, at the same place in it.
[[nodiscard]] Descriptor duplicate(int number);

// A child process gets none of these files, and a named pipe is opened without waiting for its partner.

[[nodiscard]] Descriptor open_to_read(const std::filesystem::path& path);

/// A file that exists. ENXIO for a named pipe that no process reads.
[[nodiscard]] Descriptor open_to_write(const std::filesystem::path& path);

/// A new file: EEXIST if there is one. Other users may read it unless it is private, as the umask allows; on Windows,
/// as its folder does.
[[nodiscard]] Descriptor create(const std::filesystem::path& path, bool is_private);

/// A private file, which is made if there is none; on Windows, as private as its folder.
[[nodiscard]] Descriptor open_to_append(const std::filesystem::path& path);

/// A temporary file, to write and to read, which is gone when it is closed. Throws Error{IoFailure}.
[[nodiscard]] Descriptor create_unnamed();

/// To sync it. On Windows EACCES, as for one that may not be read.
[[nodiscard]] Descriptor open_folder(const std::filesystem::path& path);

/// Locks a folder for this process, until it ends, `unlock` is called, or on Windows the descriptor is closed; no file
/// remains. EWOULDBLOCK if another run has it.
[[nodiscard]] Descriptor lock_folder(const std::filesystem::path& path);

/// What Windows has in a folder while it is locked.
inline constexpr std::string_view kLockFile = ".meshhood-lock";

void unlock(const Descriptor& folder);

struct FileStatus {
  enum class Kind { Regular, Pipe, Other };

  Kind kind;
  std::uint64_t size;
  std::uint64_t written;  // the time of the last write, in the unit of the system: only to be compared
};

/// The status of a file that has been opened. Throws Error{IoFailure} if that failed, and for a folder.
[[nodiscard]] FileStatus status_of(const Descriptor& file, const std::filesystem::path& path);

/// False only if the rights of a file forbid it.
[[nodiscard]] bool may_write(const std::filesystem::path& file);
[[nodiscard]] bool may_create_in(const std::filesystem::path& folder);

/// The number of bytes read, which may be fewer than asked for. EAGAIN and EINTR as the system has them. On Windows,
/// the second moves the position.
[[nodiscard]] std::ptrdiff_t read_some(const Descriptor& file, std::span<char> out);
[[nodiscard]] std::ptrdiff_t read_some_at(const Descriptor& file, std::uint64_t offset, std::span<char> out);

/// To a regular file. A file-size limit is an error, EFBIG, and no signal.
[[nodiscard]] bool write_all(const Descriptor& file, std::string_view bytes);

/// The same to a pipe, a terminal or a device, which is waited for as `WhileWaiting` says.
[[nodiscard]] bool write_when_ready(const Descriptor& file, std::string_view bytes);

/// The offset in a file from its start. ESPIPE if the file has none.
[[nodiscard]] std::int64_t position_of(const Descriptor& file);
[[nodiscard]] bool move_to(const Descriptor& file, std::uint64_t position);

enum class Ready { ToRead, ToWrite };

/// Waits until a file has something to read, has room to write, or is over, at most for `limit`.
[[nodiscard]] bool becomes_ready(const Descriptor& file, Ready ready, std::chrono::milliseconds limit);

/// Writes the file, or the names in a folder, to the disk.
[[nodiscard]] bool sync(const Descriptor& file);

/// Gives `file` the owner and the mode of the file that it will replace, the owner where the process may do so. Returns
/// which action failed, or "".
[[nodiscard]] std::string_view take_owner_and_mode(const Descriptor& file, const std::filesystem::path& replaced);

/// Replaces `to`, if it exists.
[[nodiscard]] bool move_over(const std::filesystem::path& from, const std::filesystem::path& to);

void remove_file(const std::filesystem::path& path) noexcept;

/// With all that is in it, as far as it can be removed.
void remove_folder(const std::filesystem::path& path) noexcept;

/// Maps a whole file into memory, read-only; it is not empty.
[[nodiscard]] std::span<const std::byte> map(const Descriptor& file, std::size_t size);
void unmap(std::span<const std::byte> bytes);

[[nodiscard]] long process_number();

}  // namespace meshhood::inline v0_1::io
