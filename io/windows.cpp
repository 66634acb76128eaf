// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>
#include <windows.h>

#include "io/messages.h"
#include "io/system.h"

// Files are binary, and no child process gets them. Reading and writing wait as long as they must: no signal interrupts
// them, but Ctrl-C ends the read of a console, and there is nothing to ask whether they would wait.
namespace meshhood::inline v0_1::io {
namespace {

constexpr int kBinary = _O_BINARY | _O_NOINHERIT;
constexpr std::size_t kMostOfACall = std::size_t{1} << 30;

Descriptor open_file(const std::filesystem::path& path, int flags) {
  constexpr int kMode = _S_IREAD | _S_IWRITE;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the interface of the system
  return Descriptor(::_wopen(path.c_str(), flags | kBinary, kMode));
}

HANDLE handle_of(const Descriptor& file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file.number())); }

/// Sets `errno` to what the last error of the system is there, EIO for one that it has not. Returns false.
bool fail_with_last_error() {
  const auto condition = std::system_category().default_error_condition(static_cast<int>(::GetLastError()));
  errno = condition.category() == std::generic_category() ? condition.value() : EIO;
  return false;
}

}  // namespace

bool Descriptor::close() {
  const int number = std::exchange(number_, -1);
  return number < 0 || ::_close(number) == 0;
}

Descriptor duplicate(int number) {
  Descriptor copy(::_dup(number));
  if (copy.is_open()) {
    ::_setmode(copy.number(), _O_BINARY);
    ::SetHandleInformation(handle_of(copy), HANDLE_FLAG_INHERIT, 0);
  }
  return copy;
}

Descriptor open_to_read(const std::filesystem::path& path) {
  if (path == kStandardInput) return duplicate(kInputNumber);
  Descriptor file = open_file(path, _O_RDONLY);
  if (file.is_open()) return file;
  const int error = errno;
  std::error_code ignored;
  // Of a folder, the system says that access is denied.
  errno = error == EACCES && std::filesystem::is_directory(path, ignored) ? EISDIR : error;
  return file;
}

Descriptor open_to_write(const std::filesystem::path& path) { return open_file(path, _O_WRONLY); }

Descriptor create(const std::filesystem::path& path, bool /*is_private*/) {
  return open_file(path, _O_WRONLY | _O_CREAT | _O_EXCL);
}

Descriptor open_to_append(const std::filesystem::path& path) {
  return open_file(path, _O_WRONLY | _O_CREAT | _O_APPEND);
}

Descriptor create_unnamed() {
  static std::atomic<unsigned> serial = 0;
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  for (;;) {
    const std::string name = ".meshhood-" + std::to_string(process_number()) + '-' + std::to_string(serial++);
    const std::filesystem::path path = (none ? std::filesystem::path(".") : folder) / name;
    Descriptor file = open_file(path, _O_RDWR | _O_CREAT | _O_EXCL | _O_TEMPORARY);
    if (file.is_open()) return file;
    if (errno != EEXIST) raise_errno(path, errno, "create");
  }
}

Descriptor open_folder(const std::filesystem::path& /*path*/) {
  errno = EACCES;
  return Descriptor();
}

/// By a file that no other process can open, and that the system removes when it is closed.
Descriptor lock_folder(const std::filesystem::path& path) {
  const HANDLE file = ::CreateFileW((path / kLockFile).c_str(), GENERIC_WRITE, 0, nullptr, OPEN_ALWAYS,
                                    FILE_FLAG_DELETE_ON_CLOSE | FILE_ATTRIBUTE_HIDDEN, nullptr);
  if (file == INVALID_HANDLE_VALUE) {
    const bool is_locked = ::GetLastError() == ERROR_SHARING_VIOLATION;
    fail_with_last_error();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) errno = ENOTDIR;
    if (is_locked) errno = EWOULDBLOCK;
    return Descriptor();
  }
  Descriptor lock(::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), 0));
  if (!lock.is_open()) ::CloseHandle(file);
  return lock;
}

/// It is released when its file is closed, which no child process has.
void unlock(const Descriptor& /*folder*/) {}

FileStatus status_of(const Descriptor& file, const std::filesystem::path& path) {
  if (!file.is_open()) {
    if (errno == EISDIR) raise_io(path, EISDIR, "is a directory, expected a file");
    raise_errno(path, errno);
  }
  using Kind = FileStatus::Kind;
  BY_HANDLE_FILE_INFORMATION status{};
  const DWORD type = ::GetFileType(handle_of(file));
  // A file that tells nothing of itself is read and written as a device is.
  if (type != FILE_TYPE_DISK || ::GetFileInformationByHandle(handle_of(file), &status) == 0) {
    return {type == FILE_TYPE_PIPE ? Kind::Pipe : Kind::Other, 0, {}};
  }
  const auto joined = [](DWORD high, DWORD low) { return std::uint64_t{high} << 32U | low; };
  const FILETIME& written = status.ftLastWriteTime;
  return {Kind::Regular, joined(status.nFileSizeHigh, status.nFileSizeLow),
          joined(written.dwHighDateTime, written.dwLowDateTime)};
}

bool may_write(const std::filesystem::path& file) {
  constexpr int kWrite = 2;
  return ::_waccess(file.c_str(), kWrite) == 0 || errno != EACCES;
}

/// That a user may not create files in it shows when one is created.
bool may_create_in(const std::filesystem::path& folder) { return ::_waccess(folder.c_str(), 0) == 0; }

std::ptrdiff_t read_some(const Descriptor& file, std::span<char> out) {
  return ::_read(file.number(), out.data(), static_cast<unsigned>(std::min(out.size(), kMostOfACall)));
}

std::ptrdiff_t read_some_at(const Descriptor& file, std::uint64_t offset, std::span<char> out) {
  OVERLAPPED at{};
  at.Offset = static_cast<DWORD>(offset);
  at.OffsetHigh = static_cast<DWORD>(offset >> 32U);
  DWORD count = 0;
  const auto most = static_cast<DWORD>(std::min(out.size(), kMostOfACall));
  if (::ReadFile(handle_of(file), out.data(), most, &count, &at) != 0 || ::GetLastError() == ERROR_HANDLE_EOF) {
    return count;
  }
  fail_with_last_error();
  return -1;
}

bool write_all(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto most = static_cast<unsigned>(std::min(bytes.size(), kMostOfACall));
    const int count = ::_write(file.number(), bytes.data(), most);
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// The C library has EINVAL for a pipe that its reader has closed.
bool write_when_ready(const Descriptor& file, std::string_view bytes) {
  if (write_all(file, bytes)) return true;
  if (errno == EINVAL && ::GetFileType(handle_of(file)) == FILE_TYPE_PIPE) errno = EPIPE;
  return false;
}

std::int64_t position_of(const Descriptor& file) { return ::_telli64(file.number()); }

bool move_to(const Descriptor& file, std::uint64_t position) {
  if (::GetFileType(handle_of(file)) == FILE_TYPE_DISK) {
    return ::_lseeki64(file.number(), static_cast<std::int64_t>(position), SEEK_SET) >= 0;
  }
  errno = ESPIPE;
  return false;
}

bool becomes_ready(const Descriptor& /*file*/, Ready /*ready*/, std::chrono::milliseconds /*limit*/) { return true; }

/// The names in a folder need it not: `move_over` has written them through.
bool sync(const Descriptor& file) { return ::_commit(file.number()) == 0; }

/// A file takes those of its folder.
std::string_view take_owner_and_mode(const Descriptor& /*file*/, const std::filesystem::path& /*replaced*/) {
  return "";
}

bool move_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  constexpr DWORD kFlags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
  return ::MoveFileExW(from.c_str(), to.c_str(), kFlags) != 0 || fail_with_last_error();
}

void remove_file(const std::filesystem::path& path) noexcept { static_cast<void>(::_wunlink(path.c_str())); }

void remove_folder(const std::filesystem::path& path) noexcept {
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  } catch (const std::bad_alloc&) {  // then it remains
  }
}

std::span<const std::byte> map(const Descriptor& file, std::size_t size) {
  const HANDLE mapping = ::CreateFileMappingW(handle_of(file), nullptr, PAGE_READONLY, 0, 0, nullptr);
  const void* const address = mapping == nullptr ? nullptr : ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, size);
  if (address == nullptr) fail_with_last_error();
  if (mapping != nullptr) ::CloseHandle(mapping);  // the view keeps it
  if (address == nullptr) return {};
  return {static_cast<const std::byte*>(address), size};
}

void unmap(std::span<const std::byte> bytes) { ::UnmapViewOfFile(bytes.data()); }

long process_number() { return ::_getpid(); }

}  // namespace meshhood::inline v0_1::io
