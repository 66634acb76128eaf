// SPDX-License-Identifier: MIT
#include "support/system_calls.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace meshhood::test {
namespace {

SystemCalls* active = nullptr;

FaultKind next(Call call) { return active == nullptr ? FaultKind::None : active->next(call); }

int fail() {
  errno = active->error();
  return -1;
}

/// `real()`, or the fault.
template <class F>
auto call_or_fail(Call call, F&& real) -> decltype(real()) {
  return next(call) == FaultKind::Error ? fail() : real();
}

/// Records the call unless it failed, and returns `result`.
template <class Result>
Result noted(Result result, Effect effect) {
  if (active != nullptr && result >= 0) active->add(std::move(effect));
  return result;
}

}  // namespace

std::string_view name_of(Call call) {
  constexpr std::array<std::string_view, kCalls> kNames = {"open",   "write", "lseek", "stat",   "fchown",
                                                           "fchmod", "fsync", "close", "rename", "unlink"};
  return kNames[static_cast<std::size_t>(call)];
}

SystemCalls::SystemCalls(const Fault& fault) : fault_(fault) { active = this; }

SystemCalls::~SystemCalls() { active = nullptr; }

FaultKind SystemCalls::next(Call call) {
  made_.push_back(call);
  if (call == Call::Unlink && fault_.stuck) return FaultKind::Error;
  if (made_.size() != fault_.at + 1) return FaultKind::None;
  if (fault_.kind == FaultKind::Kill || (fault_.kind == FaultKind::KillWithin && call != Call::Write)) {
    static_cast<void>(std::raise(SIGKILL));
  }
  return fault_.kind;
}

}  // namespace meshhood::test

// Names of the linker: calls of `f` become calls of `__wrap_f`, and `__real_f` is the original `f`.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {

int __real_open(const char* path, int flags, ...);
ssize_t __real_write(int file, const void* bytes, size_t size);
off_t __real_lseek(int file, off_t offset, int origin);
int __real_stat(const char* path, struct stat* status);
int __real_fchown(int file, uid_t owner, gid_t group);
int __real_fchmod(int file, mode_t mode);
int __real_fsync(int file);
int __real_close(int file);
int __real_rename(const char* from, const char* to);
int __real_unlink(const char* path);

using meshhood::test::Call;
using meshhood::test::call_or_fail;
using meshhood::test::FaultKind;
using meshhood::test::noted;

int __wrap_open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  const int file = call_or_fail(Call::Open, [=] { return __real_open(path, flags, mode); });
  return noted(file, {.call = Call::Open, .file = file, .path = path});
}

ssize_t __wrap_write(int file, const void* bytes, size_t size) {
  const FaultKind kind = meshhood::test::next(Call::Write);
  if (kind == FaultKind::Error) return meshhood::test::fail();
  const size_t taken = kind == FaultKind::None ? size : (size + 1) / 2;
  const ssize_t written = __real_write(file, bytes, taken);
  if (kind == FaultKind::KillWithin) static_cast<void>(std::raise(SIGKILL));
  const auto count = static_cast<size_t>(written < 0 ? 0 : written);
  return noted(written, {.call = Call::Write, .file = file, .bytes = {static_cast<const char*>(bytes), count}});
}

off_t __wrap_lseek(int file, off_t offset, int origin) {
  const off_t position = call_or_fail(Call::Seek, [=] { return __real_lseek(file, offset, origin); });
  return noted(position, {.call = Call::Seek, .file = file, .position = static_cast<std::uint64_t>(position)});
}

int __wrap_stat(const char* path, struct stat* status) {
  return call_or_fail(Call::Look, [=] { return __real_stat(path, status); });
}

int __wrap_fchown(int file, uid_t owner, gid_t group) {
  return call_or_fail(Call::ChangeOwner, [=] { return __real_fchown(file, owner, group); });
}

int __wrap_fchmod(int file, mode_t mode) {
  return call_or_fail(Call::ChangeMode, [=] { return __real_fchmod(file, mode); });
}

int __wrap_fsync(int file) {
  const int status = call_or_fail(Call::Sync, [=] { return __real_fsync(file); });
  return noted(status, {.call = Call::Sync, .file = file});
}

int __wrap_close(int file) {
  const FaultKind kind = meshhood::test::next(Call::Close);
  const int closed = noted(__real_close(file), {.call = Call::Close, .file = file});
  return kind == FaultKind::Error ? meshhood::test::fail() : closed;
}

int __wrap_rename(const char* from, const char* to) {
  const int status = call_or_fail(Call::Rename, [=] { return __real_rename(from, to); });
  return noted(status, {.call = Call::Rename, .path = from, .to = to});
}

int __wrap_unlink(const char* path) {
  const int status = call_or_fail(Call::Unlink, [=] { return __real_unlink(path); });
  return noted(status, {.call = Call::Unlink, .path = path});
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
