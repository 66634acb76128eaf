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
/// A function that fails returns a closed descriptor, a negative number or false, and sets `errno`, unless it says that
/// it throws.
namespace meshhood::io {

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

/// A new file: EEXIST if there is one. The others may read what is not private, as far as the process lets them.
[[nodiscard]] Descriptor create(const std::filesystem::path& path, bool is_private);

/// A private file, which is made if there is none.
[[nodiscard]] Descriptor open_to_append(const std::filesystem::path& path);

/// A file that ends when it is closed. Throws Error{IoFailure}.
[[nodiscard]] Descriptor create_unnamed();

/// To sync it. Windows has no such thing.
[[nodiscard]] Descriptor open_folder(const std::filesystem::path& path);

/// Locks a folder for this process, until it ends or `unlock` is called; no file remains. EWOULDBLOCK if another run
/// has it.
[[nodiscard]] Descriptor lock_folder(const std::filesystem::path& path);
void unlock(const Descriptor& folder);

struct FileStatus {
  enum class Kind { Regular, Pipe, Other };

  Kind kind;
  std::uint64_t size;
  std::chrono::nanoseconds written;  // since the epoch of the system
};

/// The status of a file that has been opened. Throws Error{IoFailure} if that failed, and for a folder.
[[nodiscard]] FileStatus status_of(const Descriptor& file, const std::filesystem::path& path);

/// Whether the process may write to a file that exists, or create files in a folder.
[[nodiscard]] bool may_write(const std::filesystem::path& file);
[[nodiscard]] bool may_create_in(const std::filesystem::path& folder);

/// The number of bytes read or written, which may be fewer. EAGAIN and EINTR as the system has them.
[[nodiscard]] std::ptrdiff_t read_some(const Descriptor& file, std::span<char> out);
[[nodiscard]] std::ptrdiff_t read_some_at(const Descriptor& file, std::uint64_t offset, std::span<char> out);

/// To a regular file. A file-size limit is an error, EFBIG, and no signal.
[[nodiscard]] bool write_all(const Descriptor& file, std::string_view bytes);

/// The same to a pipe, a terminal or a device, which is waited for as `WhileWaiting` says.
[[nodiscard]] bool write_when_ready(const Descriptor& file, std::string_view bytes);

/// The offset in a file, from its start: where it is, or moved to. ESPIPE if it has none.
[[nodiscard]] std::int64_t position_of(const Descriptor& file);
[[nodiscard]] bool move_to(const Descriptor& file, std::uint64_t position);

/// Whether a file has something to read, has room to write, or is over. Waits for it, at most for `limit`.
enum class Ready { ToRead, ToWrite };
[[nodiscard]] bool is_ready(const Descriptor& file, Ready ready, std::chrono::milliseconds limit);

/// Writes the file, or the names in a folder, to the disk.
[[nodiscard]] bool sync(const Descriptor& file);

/// Gives `file` the owner and the mode of the file that it will replace, the owner where the process may do so. Returns
/// which action failed, or "".
[[nodiscard]] std::string_view take_owner_and_mode(const Descriptor& file, const std::filesystem::path& replaced);

/// Replaces `to`, if it exists.
[[nodiscard]] bool move_over(const std::filesystem::path& from, const std::filesystem::path& to);

void remove_file(const std::filesystem::path& path) noexcept;

/// With all that is in it. Allocates nothing.
void remove_folder(const std::filesystem::path& path) noexcept;

/// Maps a whole file into memory, read-only; it is not empty.
[[nodiscard]] std::span<const std::byte> map(const Descriptor& file, std::size_t size);
void unmap(std::span<const std::byte> bytes);

[[nodiscard]] long process_number();

}  // namespace meshhood::io
